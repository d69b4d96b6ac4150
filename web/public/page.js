'use strict'
// What the superintendent sees. Words and numbers are those of the server; nothing is computed here but countdowns, the
// speed of opening and units.

const NO_DATA_AFTER = 2000 // ms; it has to be seen within 3 s, on a slow tablet too
const OLD_FORECAST = 30 // s; an older one is not shown as if it were of now
const OLD_ENSEMBLE = 60 // s

const element = id => document.getElementById(id)
const history = [] // [s, N/m] of the last minute
const angles = [] // [s, rad, rad] of the last seconds

const STATES = {
  waiting: 'Waiting', releasing: 'Releasing', released: 'Out', hung_up: 'Stuck', none: 'No container', ruptured: 'Torn'
}

/** Shows text; the exact value it stands for is kept beside it. */
function show (id, text, value) {
  element(id).textContent = text
  if (value === undefined || value === null) delete element(id).dataset.value
  else element(id).dataset.value = JSON.stringify(value)
}

const degrees = (rad, digits) => (rad * 180 / Math.PI).toFixed(digits) + '°'
const percent = ratio => (100 * ratio).toFixed(0) + ' %'
const kilo = newton => (newton / 1000).toFixed(1) + ' kN/m'
const isNumber = value => typeof value === 'number' && Number.isFinite(value)

function duration (seconds) {
  const whole = Math.round(seconds)
  if (whole <= 0) return 'now'
  return whole < 100 ? `${whole} s` : `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`
}

function reader (feed) {
  const now = feed.values.has('tension.current') ? feed.values.get('tension.current').time / 1000 : NaN
  const entry = path => feed.values.get(path)
  return {
    now,
    value: path => (entry(path) ? entry(path).value : null),
    time: path => (entry(path) ? entry(path).time / 1000 : NaN),
    /** Of a forecast or an ensemble: nothing when it is too old. */
    recent: (path, limit) => (entry(path) && now - entry(path).time / 1000 <= limit ? entry(path).value : null)
  }
}

function remember (now, tension, port, starboard) {
  const last = history[history.length - 1]
  if (last && now < last[0]) { // the log began anew
    history.length = 0
    angles.length = 0
  } else if (last && now === last[0]) return
  if (isNumber(tension)) history.push([now, tension])
  if (isNumber(port) && isNumber(starboard)) angles.push([now, port, starboard])
  while (history.length && history[0][0] < now - PAST_S) history.shift()
  while (angles.length && angles[0][0] < now - 2) angles.shift()
}

function showOpening (read) {
  for (const side of ['port', 'starboard']) {
    const angle = read.value(`hull.${side}.opening`)
    show(side, isNumber(angle) ? degrees(angle, 1) : '–', angle)
  }
  const [first, last] = [angles[0], angles[angles.length - 1]]
  const speed = first && last[0] - first[0] > 0.5
    ? 0.5 * (last[1] + last[2] - first[1] - first[2]) / (last[0] - first[0]) : null
  show('speed', speed === null ? '–' : degrees(Math.abs(speed) < 1e-4 ? 0 : speed, 1) + '/s')
}

function showOut (read) {
  const state = read.value('release.state')
  const instant = Date.parse(read.recent('forecast.release.instant', OLD_FORECAST)) / 1000
  const outcome = read.recent('forecast.outcome', OLD_FORECAST)
  const stale = read.recent('forecast.state', OLD_FORECAST) === 'stale'
  element('out').classList.toggle('alarm', state === 'hung_up' || (state !== 'released' && outcome === 'hung_up'))
  element('out-title').textContent = state === 'released' ? 'Container' : 'Out in'
  if (state === 'released') show('out-in', 'Out')
  else if (state === 'hung_up') show('out-in', 'Stuck')
  else if (isNumber(instant)) show('out-in', duration(instant - read.now), read.value('forecast.release.instant'))
  else if (outcome === 'hung_up') show('out-in', 'Gets stuck')
  else show('out-in', outcome === null ? '–' : 'Not soon')

  const notes = []
  if (outcome === null && state !== 'released') notes.push('no forecast')
  if (stale) notes.push('being worked out anew')
  const since = read.now - read.time('ensemble.release.p10')
  const early = read.recent('ensemble.release.p10', OLD_ENSEMBLE)
  const late = read.recent('ensemble.release.p90', OLD_ENSEMBLE)
  const stuck = read.recent('ensemble.probability.hung_up', OLD_ENSEMBLE)
  if (state !== 'released' && isNumber(early) && isNumber(late)) {
    notes.push(`likely ${duration(early - since)} to ${duration(late - since)}`)
  }
  if (state !== 'released' && isNumber(stuck) && stuck >= 0.005) notes.push(`chance to get stuck ${percent(stuck)}`)
  show('out-band', notes.join(' · '), isNumber(early) && isNumber(late) ? [early, late] : null)
}

function zoneOf (zones, value) {
  const inside = zones.find(z => (z.lower === undefined || value >= z.lower) && (z.upper === undefined || value < z.upper))
  return inside ? inside.state : 'normal'
}

function showLoad (read, zones) {
  const peak = read.value('utilisation.peak')
  const zone = isNumber(peak) ? zoneOf(zones, peak) : 'normal'
  element('load').classList.toggle('alarm', zone === 'alarm')
  element('load').classList.toggle('warn', zone === 'warn')
  show('load-now', isNumber(peak) ? percent(peak) : '–', peak)
  const notes = ['of its strength']
  const expected = read.recent('forecast.utilisation.peak', OLD_FORECAST)
  const [low, high] = ['p10', 'p90'].map(p => read.recent(`ensemble.utilisation.${p}`, OLD_ENSEMBLE))
  const torn = read.recent('ensemble.probability.ruptured', OLD_ENSEMBLE)
  if (isNumber(expected)) notes.push(`will reach ${percent(expected)}`)
  if (isNumber(low) && isNumber(high)) notes.push(`likely ${percent(low)} to ${percent(high)}`)
  if (isNumber(torn) && torn >= 0.005) notes.push(`chance to tear ${percent(torn)}`)
  show('load-expected', notes.join(' · '), expected)
}

function showAdvice (read) {
  const advice = read.value('release.state') === 'released' ? null : read.recent('advice.state', OLD_ENSEMBLE)
  const [rate, slowest] = ['rate', 'slowest'].map(name => read.recent(`advice.${name}`, OLD_ENSEMBLE))
  const both = slowest === rate ? `${degrees(rate, 2)}/s` : `${degrees(slowest, 2)} to ${degrees(rate, 2)}/s`
  element('advice').classList.toggle('alarm', advice === 'no_rate')
  const words = {
    any_rate: 'Any opening speed is safe',
    rate: !isNumber(rate) ? 'No advice' : slowest > 0 ? `Open at ${both}` : `Open no faster than ${degrees(rate, 2)}/s`,
    rate_so_far: isNumber(rate) ? `${both} is safe` : 'No advice',
    no_rate: 'No opening speed keeps it safe'
  }
  show('advice-words', words[advice] || 'No advice', words[advice] && isNumber(rate) ? rate : null)
  show('advice-message', words[advice] ? read.value('advice.message') || '' : '')
}

function showPull (read, zones) {
  const tension = read.value('tension.current')
  const peak = read.value('tension.peak')
  const use = read.value('utilisation.peak')
  show('pull-now', isNumber(tension) ? `now ${kilo(tension)} · highest ${kilo(peak)}` : '', tension)
  const curve = columns(read.recent('forecast.curve', OLD_FORECAST), ['time', 'tension'])
  const band = columns(read.recent('ensemble.tension.curve', OLD_ENSEMBLE), ['time', 'p10', 'p90'])
  const instant = Date.parse(read.recent('forecast.release.instant', OLD_FORECAST)) / 1000
  // The seam's strength is what the peak is a part of.
  const strength = isNumber(peak) && use > 1e-3 ? peak / use : null
  const limits = strength === null ? [] : zones.filter(z => z.lower > 0).map(z => [z.lower * strength, z.state])
  drawChart(element('chart'), {
    now: read.now,
    history,
    curve: curve ? curve.time.map((t, i) => [t, curve.tension[i]]) : [],
    band: band ? band.time.map((t, i) => [t, band.p10[i], band.p90[i]]) : [],
    limits,
    release: isNumber(instant) ? instant : null
  })
}

function showAlarms (notices) {
  const raised = [...notices].filter(([name, notice]) => notice && ['alert', 'warn', 'alarm', 'emergency'].includes(notice.state) &&
    // The server's own alarm from the zones of a path says what the seam's says.
    !(name === 'utilisation.peak' && notices.has('seam_utilisation')))
  const isAlarm = notice => notice.state === 'alarm' || notice.state === 'emergency'
  raised.sort((a, b) => isAlarm(b[1]) - isAlarm(a[1]) || a[0].localeCompare(b[0]))
  const lines = raised.map(([name, notice]) => {
    const seen = notice.acknowledged === true || Boolean(notice.status && notice.status.acknowledged)
    const line = document.createElement('p')
    line.className = isAlarm(notice) ? 'alarm' : 'warn'
    line.classList.toggle('seen', seen)
    line.dataset.name = name
    const words = document.createElement('span')
    words.textContent = notice.message || name
    const mark = document.createElement('span')
    mark.className = 'mark'
    mark.textContent = seen ? 'acknowledged' : 'not acknowledged'
    line.append(words, mark)
    return line
  })
  if (lines.length === 0) {
    const line = document.createElement('p')
    line.className = 'none'
    line.textContent = 'No alarms'
    lines.push(line)
  }
  element('alarms').replaceChildren(...lines)
}

function showAll (feed) {
  const read = reader(feed)
  if (!isNumber(read.now)) return
  const zones = (feed.meta.get('utilisation.peak') || {}).zones || []
  const [port, starboard] = ['port', 'starboard'].map(side => read.value(`hull.${side}.opening`))
  remember(read.now, read.value('tension.current'), port, starboard)
  const state = read.value('release.state')
  show('state', STATES[state] || '–', state)
  const lag = read.value('lag')
  show('message', (isNumber(lag) && lag > 1 ? `The prediction is ${lag.toFixed(1)} s behind. ` : '') +
    (read.value('release.message') || ''), read.value('release.message'))
  show('clock', new Date(read.now * 1000).toISOString().slice(11, 19) + ' UTC')
  element('replay').hidden = !feed.values.get('tension.current').source.endsWith('.replay')
  showOpening(read)
  showOut(read)
  showLoad(read, zones)
  showAdvice(read)
  showAlarms(feed.notices)
  const hull = columns(read.value('hull.section'), ['y', 'z', 'hinge'])
  drawSection(element('section'), hull, port || 0, starboard || 0, columns(read.value('shape'), ['y', 'z', 'utilisation']))
  showPull(read, zones)
}

/** A screen that stands still must not look like a release that does. */
function watch (feed) {
  const silence = performance.now() - feed.heard
  const old = silence > NO_DATA_AFTER
  element('no-data').hidden = !old
  document.body.classList.toggle('old', old)
  if (old) {
    element('no-data').textContent = `NO DATA for ${Math.floor(silence / 1000)} s` +
      (feed.connected ? ' – do not rely on this screen' : ' – no connection to the server')
  }
}

function chooseTheme () {
  let kept = null
  try { kept = localStorage.getItem('theme') } catch {} // not of a file, in some browsers
  const dark = window.matchMedia('(prefers-color-scheme: dark)').matches
  const set = theme => {
    document.documentElement.dataset.theme = theme
    element('theme').textContent = theme === 'night' ? 'Day' : 'Night'
  }
  set(kept || (dark ? 'night' : 'day'))
  element('theme').addEventListener('click', () => {
    const theme = document.documentElement.dataset.theme === 'night' ? 'day' : 'night'
    set(theme)
    try { localStorage.setItem('theme', theme) } catch {}
  })
}

chooseTheme()
let drawn = false // at most once a frame, however fast values come
const feed = openFeed(serverAddress(window.location), () => {
  if (drawn) return
  drawn = true
  requestAnimationFrame(() => {
    drawn = false
    showAll(feed)
    watch(feed)
  })
})
setInterval(() => watch(feed), 250)
