/** Plays recorded frames of a stream at their original intervals, repeatedly. */

/** @param {function({records: Object[]})} apply called with each parsed frame; event times are set to now */
export async function play(apply) {
  const lines = (await (await fetch('/frames/recorded')).text()).trim().split('\n').map((line) => [Number(line.slice(0, line.indexOf(' '))), line.slice(line.indexOf(' ') + 1)]);
  const length = lines.at(-1)[0] + lines[1][0] - lines[0][0];
  let [start, next] = [performance.now(), 0];
  const step = () => {
    while (performance.now() - start >= lines[next][0]) {
      const frame = JSON.parse(lines[next][1]);
      const now = Date.now();
      for (const record of frame.records) {
        record.time = now;
      }
      apply(frame);
      next++;
      if (next === lines.length) {
        next = 0;
        start += length;
      }
    }
    setTimeout(step, Math.max(0, lines[next][0] - (performance.now() - start)));
  };
  step();
}

/** Counts the frames that an OpenLayers map draws in `window.drawn`. */
export function count(map) {
  window.drawn = 0;
  map.on('postrender', () => window.drawn++);
}
