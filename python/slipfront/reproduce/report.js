// The value under the cursor of each figure, and a larger view on a click of its button. Nothing is loaded.
"use strict";
(() => {
  const say = document.createElement("div");
  say.id = "value";
  say.hidden = true;
  document.body.append(say);

  const short = value => value === null ? "not finite" : Number(value.toPrecision(4)).toString();
  // Share of an axis -> value, and back.
  const at = (axis, share) => axis.log ? axis.ends[0] * Math.pow(axis.ends[1] / axis.ends[0], share)
                                       : axis.ends[0] + share * (axis.ends[1] - axis.ends[0]);
  const shareOf = (axis, value) => axis.log ? Math.log(value / axis.ends[0]) / Math.log(axis.ends[1] / axis.ends[0])
                                            : (value - axis.ends[0]) / (axis.ends[1] - axis.ends[0]);
  const nearest = (values, wanted) => values.reduce((best, value, i) => Math.abs(value - wanted) < Math.abs(values[best] - wanted) ? i : best, 0);

  // The point of a line nearest to the pointer: [distance in pixels, name, x, y, share across, share up].
  function closest(axes, across, up, width, height) {
    let best = [Infinity];
    for (const line of axes.lines) {
      for (let i = 0; i < line.x.length; ++i) {
        if (line.x[i] === null || line.y[i] === null) continue;
        const shares = [shareOf(axes.x, line.x[i]), shareOf(axes.y, line.y[i])];
        const distance = Math.hypot((shares[0] - across) * width, (shares[1] - up) * height);
        if (distance < best[0]) best = [distance, line.name, line.x[i], line.y[i], ...shares];
      }
    }
    return best;
  }

  function describe(axes, across, up, width, height) {
    const [distance, name, x, y, ...shares] = closest(axes, across, up, width, height);
    if (distance < 24) return {text: `${name ? name + "\n" : ""}${axes.x.name}: ${short(x)}\n${axes.y.name}: ${short(y)}`, shares};
    const place = [at(axes.x, across), at(axes.y, up)];
    let text = `${axes.x.name}: ${short(place[0])}\n${axes.y.name}: ${short(place[1])}`;
    if (axes.map) {
      const column = nearest(axes.map.x, place[0]), row = nearest(axes.map.y, place[1]);
      text += `\nvalue: ${short(axes.map.z[row * axes.map.x.length + column])}`;
    }
    return {text, shares: [across, up]};
  }

  function answer(event, picture, all, mark) {
    const frame = picture.getBoundingClientRect();
    const x = (event.clientX - frame.left) / frame.width, y = (event.clientY - frame.top) / frame.height;
    for (const axes of all) {
      const [left, top, width, height] = axes.box;
      const across = (x - left) / width, up = 1 - (y - top) / height;
      if (across < 0 || across > 1 || up < 0 || up > 1) continue;
      const {text, shares} = describe(axes, across, up, width * frame.width, height * frame.height);
      mark.hidden = say.hidden = false;
      mark.style.left = `${100 * (left + shares[0] * width)}%`;
      mark.style.top = `${100 * (top + (1 - shares[1]) * height)}%`;
      say.textContent = text;
      const right = event.clientX + 16 + say.offsetWidth < innerWidth;
      say.style.left = `${Math.max(4, right ? event.clientX + 16 : event.clientX - 16 - say.offsetWidth)}px`;
      say.style.top = `${Math.max(4, Math.min(event.clientY + 16, innerHeight - say.offsetHeight - 4))}px`;
      return;
    }
    mark.hidden = say.hidden = true;
  }

  for (const figure of document.querySelectorAll("figure")) {
    const picture = figure.querySelector(".picture"), data = figure.querySelector("script[type='application/json']");
    figure.querySelector("button").addEventListener("click", event => {
      event.target.textContent = figure.classList.toggle("large") ? "smaller" : "larger";
    });
    if (!data) continue;
    const all = JSON.parse(data.textContent), mark = document.createElement("span");
    mark.className = "mark";
    mark.hidden = true;
    picture.append(mark);
    for (const kind of ["pointermove", "pointerdown"]) picture.addEventListener(kind, event => answer(event, picture, all, mark));
    picture.addEventListener("pointerleave", () => { mark.hidden = say.hidden = true; });
  }
})();
