'use strict'
// Values of the release from a Signal K server's WebSocket. Nothing is ever sent to it but the subscription.

const PREFIX = 'cargo.geocontainer'

/** host:port of `?server=`, else whoever served this page. */
function serverAddress (location) {
  const asked = new URLSearchParams(location.search).get('server')
  const secure = location.protocol === 'https:'
  const host = asked || location.host || 'localhost:3000'
  return `${secure ? 'wss' : 'ws'}://${host}/signalk/v1/stream?subscribe=none&sendMeta=all`
}

/**
 * Follows the server for ever. `feed.values` holds {value, time, source} by path below the prefix, `feed.notices` the
 * notifications by name, `feed.meta` units and zones by path; `onChange` is called after each message that brought some.
 */
function openFeed (address, onChange) {
  const feed = { values: new Map(), notices: new Map(), meta: new Map(), connected: false, heard: performance.now() }
  const longestSilence = 10e3 // ms; then the connection is thought to be dead, whatever the socket says
  let socket = null
  let opened = 0
  let told = new Set() // paths, on this connection

  /** True when it is live: the first value of a path may be an old one that the server keeps, and a status at rest keeps its stamp. */
  function take (path, value, time, source) {
    const live = told.has(path)
    told.add(path)
    if (path.startsWith(`notifications.${PREFIX}.`)) feed.notices.set(path.slice(15 + PREFIX.length), value)
    else if (path.startsWith(PREFIX + '.')) feed.values.set(path.slice(PREFIX.length + 1), { value, time, source })
    return live
  }

  function read (text) {
    let message
    try { message = JSON.parse(text) } catch { return }
    let live = false
    for (const update of message.updates || []) {
      const time = Date.parse(update.timestamp)
      for (const entry of update.values || []) live = take(entry.path, entry.value, time, update.$source || '') || live
      for (const entry of update.meta || []) {
        if (entry.path.startsWith(PREFIX + '.')) feed.meta.set(entry.path.slice(PREFIX.length + 1), entry.value)
      }
    }
    if (live) feed.heard = performance.now()
    onChange(feed)
  }

  function connect () {
    opened = performance.now()
    told = new Set()
    socket = new WebSocket(address)
    const mine = socket
    mine.onopen = () => {
      feed.connected = true
      // What the server has, and then every change: it may have missed the end of an alarm while we were away.
      feed.notices.clear()
      mine.send(JSON.stringify({
        context: 'vessels.self',
        subscribe: [PREFIX, `notifications.${PREFIX}`].map(path => ({ path: path + '.*', policy: 'instant' }))
      }))
    }
    mine.onmessage = event => { if (mine === socket) read(event.data) }
    mine.onclose = () => {
      if (mine !== socket) return
      feed.connected = false
      socket = null
      setTimeout(connect, 1000)
    }
  }

  setInterval(() => {
    if (socket && performance.now() - Math.max(feed.heard, opened) > longestSilence) {
      const dead = socket
      socket = null
      dead.close()
      connect()
    }
  }, 1000)
  connect()
  return feed
}
