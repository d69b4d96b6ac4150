'use strict'
// The two pictures, as SVG made of numbers alone: no text that came from the network is put in as markup.

/** Green at 0 over yellow at a half to red at 1, magenta beyond: the colours of the package's other pictures. */
function utilisationColour (use) {
  if (use > 1) return '#d900d9'
  const green = [38, 166, 77]
  const yellow = [255, 217, 26]
  const red = [217, 26, 26]
  const mix = (a, b, t) => `rgb(${a.map((v, i) => Math.round(v + (b[i] - v) * t)).join(',')})`
  return use < 0.5 ? mix(green, yellow, 2 * Math.max(use, 0)) : mix(yellow, red, 2 * use - 1)
}

const fixed = number => number.toFixed(3)
const pointList = points => points.map(p => p.map(fixed).join(',')).join(' ')

/** Numbers of the same count under each name, or nothing. */
function columns (value, names) {
  if (!value || !names.every(name => Array.isArray(value[name]) && value[name].every(Number.isFinite))) return null
  return value
}

/**
 * Seen from astern, so that port is left: a point (y, z) of the barge is drawn at (-y, -z), in metres.
 * @param hull {y, z, hinge, bed?} of the port half, closed, or null
 * @param outline {y, z, utilisation} or null
 */
function drawSection (svg, hull, portRad, starboardRad, outline) {
  const parts = []
  let bottom = 5
  let reach = 5
  if (hull) {
    // The outer side is for the eye only.
    const points = hull.y.map((y, i) => [y, hull.z[i]])
    const outer = 2 * Math.max(...hull.y)
    const deck = hull.z[hull.z.length - 1]
    points.push([outer, deck], [outer, hull.z[0] + 0.35 * (deck - hull.z[0])])
    reach = outer + 1.2
    bottom = -Math.min(...hull.z) + 1
    for (const [side, angle] of [[-1, portRad], [1, starboardRad]]) {
      const [c, s] = [Math.cos(angle), Math.sin(angle)]
      const turned = points.map(([y, z]) => {
        const [dy, dz] = [y - hull.hinge[0], z - hull.hinge[1]]
        return [side * (hull.hinge[0] + dy * c - dz * s), -(hull.hinge[1] + dy * s + dz * c)]
      })
      parts.push(`<polygon points="${pointList(turned)}" fill="var(--hull)"/>`)
    }
    if (Array.isArray(hull.bed) && Number.isFinite(hull.bed[0])) {
      bottom = -hull.bed[0] + 0.5
      parts.push(`<rect x="-50" y="${fixed(-hull.bed[0])}" width="100" height="50" fill="var(--bed)"/>`)
    }
  }
  if (outline) {
    const points = outline.y.map((y, i) => [-y, -outline.z[i]])
    bottom = Math.max(bottom, ...points.map(p => p[1] + 0.5))
    parts.push(`<polygon points="${pointList(points)}" fill="var(--sand)"/>`)
    outline.utilisation.forEach((use, i) => {
      const ends = [points[i], points[(i + 1) % points.length]]
      parts.push(`<polyline points="${pointList(ends)}" fill="none" stroke="${utilisationColour(use)}" ` +
        'stroke-width="0.22" stroke-linecap="round"/>')
    })
  }
  svg.setAttribute('viewBox', `${fixed(-reach)} -1.2 ${fixed(2 * reach)} ${fixed(bottom + 1.2)}`)
  svg.innerHTML = parts.join('')
}

const PAST_S = 60
const AHEAD_S = 60

/**
 * @param chart {now (s), history [[s, N/m]], curve [[s, N/m]], band [[s, p10, p90]], limits [[N/m, class]],
 *   release (s) or null}
 */
function drawChart (svg, chart) {
  const box = svg.getBoundingClientRect()
  if (box.width < 50 || box.height < 50) return
  const size = parseFloat(getComputedStyle(document.documentElement).fontSize)
  const [left, right, top, below] = [3.2 * size, box.width - 0.5 * size, 1.1 * size, box.height - 1.4 * size]
  const inSight = p => p[0] >= chart.now && p[0] <= chart.now + AHEAD_S
  const ahead = chart.curve.filter(inSight)
  const band = chart.band.filter(inSight)
  const known = [...chart.history, ...ahead].map(p => p[1]).concat(band.map(p => p[2]), chart.limits.map(l => l[0]))
  const highest = 1.08 * Math.max(1000, ...known)
  const x = t => left + (right - left) * (t - chart.now + PAST_S) / (PAST_S + AHEAD_S)
  const y = tension => below - (below - top) * tension / highest
  const line = (x1, y1, x2, y2, style) =>
    `<line x1="${fixed(x1)}" y1="${fixed(y1)}" x2="${fixed(x2)}" y2="${fixed(y2)}" ${style}/>`
  const label = (px, py, text, anchor) =>
    `<text x="${fixed(px)}" y="${fixed(py)}" font-size="${fixed(0.9 * size)}" text-anchor="${anchor}">${text}</text>`
  const curve = (points, style) =>
    `<polyline points="${pointList(points.map(p => [x(p[0]), y(p[1])]))}" fill="none" ${style}/>`
  const parts = []
  const now = x(chart.now)
  if (band.length > 1) {
    const edge = [...band.map(p => [x(p[0]), y(p[2])]), ...band.map(p => [x(p[0]), y(p[1])]).reverse()]
    parts.push(`<polygon points="${pointList(edge)}" fill="var(--band)"/>`)
    const last = band[band.length - 1]
    const beside = x(last[0]) < right - 6 * size
    parts.push(label(beside ? x(last[0]) + 6 : right - 4, y(last[2]) + (beside ? 0.8 : -0.3) * size, 'likely pull',
      beside ? 'start' : 'end'))
  }
  for (const [tension, kind] of chart.limits) {
    const colour = kind === 'alarm' ? 'var(--alarm)' : 'var(--warn)'
    parts.push(line(left, y(tension), right, y(tension), `stroke="${colour}" stroke-width="4"`))
    if (kind === 'alarm') parts.push(label(left + 6, y(tension) + size, 'limit', 'start'))
  }
  for (const tension of ticks(highest)) {
    parts.push(label(left - 6, y(tension) + 0.3 * size, (tension / 1000).toFixed(0), 'end'))
    parts.push(line(left, y(tension), right, y(tension), 'stroke="var(--line)" stroke-width="0.5"'))
  }
  parts.push(label(left - 6, top - 0.25 * size, 'kN/m', 'end'))
  for (const second of [-60, -30, 0, 30, 60]) {
    const text = second === 0 ? 'now' : `${second > 0 ? '+' : '−'}${Math.abs(second)} s`
    parts.push(label(x(chart.now + second), box.height - 0.3 * size, text, second === 60 ? 'end' : 'middle'))
  }
  parts.push(line(now, top, now, below, 'stroke="var(--ink)" stroke-width="2"'))
  if (chart.release !== null && chart.release > chart.now && chart.release < chart.now + AHEAD_S) {
    const out = x(chart.release)
    parts.push(line(out, top, out, below, 'stroke="var(--forecast)" stroke-width="3" stroke-dasharray="4 6"'))
    parts.push(label(out + 6, (top + below) / 2, 'out', 'start'))
  }
  parts.push(curve(ahead, 'stroke="var(--forecast)" stroke-width="4" stroke-dasharray="12 6"'))
  parts.push(curve(chart.history, 'stroke="var(--ink)" stroke-width="4"'))
  svg.setAttribute('viewBox', `0 0 ${fixed(box.width)} ${fixed(box.height)}`)
  svg.innerHTML = parts.join('')
}

/** Three or four round values up to the highest. */
function ticks (highest) {
  const rough = highest / 3.5
  const power = 10 ** Math.floor(Math.log10(rough))
  const step = power * ([1, 2, 5].find(m => m * power >= rough) || 10)
  const values = []
  for (let value = 0; value <= highest; value += step) values.push(value)
  return values
}
