// The names at the edges: every model where there is room, else every so many or the named blocks; those of the fields in
// question always, in bold.
const createLabels = (pen, v, state, source, css) => {
  const LABEL = 14, HALF = 7, ROUND = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
  const models = (from, to, near) => {
    const every = ROUND.find((step) => step >= LABEL / v.cell) || ROUND[ROUND.length - 1], found = [];
    for (let place = from; place < to; place++)
      if (((place + 1) % every === 0 || every === 1) && near.every((other) => Math.abs(other - place) * v.cell >= LABEL)) found.push([place + 0.5, source.name(state.order[place])]);
    return found;
  };
  const blocks = (from, to, near) => {
    const found = [];
    let last = -LABEL / v.cell;
    for (const [start, count, name] of state.blocks) {
      const low = Math.max(start, from), high = Math.min(start + count, to), middle = (low + high) / 2;
      if (!name || high <= low || (middle - last) * v.cell < LABEL || near.some((other) => Math.abs(other + 0.5 - middle) * v.cell < LABEL)) continue;
      found.push([middle, name]);
      last = middle;
    }
    return found;
  };
  const room = (across) => (across ? v.width : v.height) - HALF; // up to here a name is not cut off
  const apart = (places, most) => { // neighbours move away from each other, so that both are read
    const by = (LABEL - 1) / v.cell;
    const found = [...places].sort((a, b) => a - b).map((place) => [place + 0.5, place]);
    for (let k = 1; k < found.length; k++) found[k][0] = Math.max(found[k][0], found[k - 1][0] + by);
    for (let k = found.length - 1; k >= 0; k--) found[k][0] = Math.min(found[k][0], most - (found.length - 1 - k) * by);
    return found;
  };
  const write = ([place, text], across, bold) => {
    const exact = v.gutter + (across ? v.left : v.top) + place * v.cell, upright = v.cell < 26 || v.gutter > 60;
    if (exact < v.gutter - 1 || exact > (across ? v.width : v.height)) return;
    const middle = Math.min(exact, room(across));
    pen.save();
    if (across) pen.translate(middle, v.gutter - 5), upright && pen.rotate(-Math.PI / 2);
    else pen.translate(v.gutter - 5, middle);
    pen.font = `${bold ? 700 : 400} 11px system-ui, sans-serif`;
    pen.textAlign = across ? (upright ? "left" : "center") : "right";
    pen.textBaseline = across && !upright ? "bottom" : "middle";
    const most = v.gutter - 8;
    if (bold) {
      const wide = Math.min(most, pen.measureText(text).width) + 6;
      pen.fillStyle = css("paper");
      if (across && !upright) pen.fillRect(-wide / 2, -13, wide, 14);
      else pen.fillRect(across ? -3 : 3 - wide, -8, wide, 16);
    }
    pen.fillStyle = css(bold ? "ink" : "muted");
    pen.fillText(text, 0, 0, most);
    pen.restore();
  };
  return {
    gutter: () => { // room for the longest name, within reason: longer ones are condensed
      pen.font = "400 11px system-ui, sans-serif";
      const longest = state.order.map(source.name).reduce((a, b) => (b.length > a.length ? b : a), "");
      return Math.max(42, Math.min(pen.measureText(longest).width + 9, 88, 0.2 * v.width));
    },
    draw: ([r0, r1, c0, c1], strong) => {
      const near = strong.map((model) => state.place[model]);
      const usual = v.cell < LABEL && state.blocks.some((block) => block[2]) ? blocks : models;
      for (const [from, to, across] of [[r0, r1, false], [c0, c1, true]]) {
        for (const label of usual(from, to, near)) write(label, across, false);
        const most = (room(across) - v.gutter - (across ? v.left : v.top)) / v.cell;
        for (const [at, place] of apart(near.filter((place) => place >= from && place < to), most)) write([at, source.name(state.order[place])], across, true);
      }
    },
  };
};
