// Shows the value under the cursor of each figure, and enlarges a figure when its button is clicked. The script loads nothing.
"use strict";
(() => {
  const say = document.createElement("div");
  say.id = "value";
  say.hidden = true;
  document.body.append(say);

  const short = value => value === null ? "not finite" : Number(value.toPrecision(4)).toString();
  // `at` converts a fraction of an axis to a value, and `shareOf` a value to a fraction.
  const at = (axis, share) => axis.log ? axis.ends[0] * Math.pow(axis.ends[1] / axis.ends[0], share)
                                       : axis.ends[0] + share * (axis.ends[1] - axis.ends[0]);
  const shareOf = (axis, value) => axis.log ? Math.log(value / axis.ends[0]) / Math.log(axis.ends[1] / axis.ends[0])
                                            : (value - axis.ends[0]) / (axis.ends[1] - axis.ends[0]);
  const nearest = (values, wanted) => values.reduce((best, value, i) => Math.abs(value - wanted) < Math.abs(values[best] - wanted) ? i : best, 0);

  // Returns the point of a line that is nearest to the pointer: [distance in pixels, name, x, y, fraction of the x axis, of the y axis].
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

  // Returns the point of a surface that appears nearest to the pointer, or null if none is near.
  function onSurface(axes, x, y, frame) {
    const {left, top} = axes.surface;
    const distance = i => Math.hypot((left[i] - x) * frame.width, (top[i] - y) * frame.height);
    const i = left.reduce((best, _, j) => distance(j) < distance(best) ? j : best, 0);
    if (distance(i) > 24) return null;
    return {text: ["x", "y", "z"].map(name => `${axes[name].name}: ${short(axes.surface[name][i])}`).join("\n"), left: left[i], top: top[i]};
  }

  // Returns the text and the position of the mark for a point of flat axes, or null outside the axes.
  function onPlane(axes, x, y, frame) {
    const [left, top, width, height] = axes.box;
    const across = (x - left) / width, up = 1 - (y - top) / height;
    if (across < 0 || across > 1 || up < 0 || up > 1) return null;
    const {text, shares} = describe(axes, across, up, width * frame.width, height * frame.height);
    return {text, left: left + shares[0] * width, top: top + (1 - shares[1]) * height};
  }

  function answer(event, picture, all, mark) {
    const frame = picture.getBoundingClientRect();
    const x = (event.clientX - frame.left) / frame.width, y = (event.clientY - frame.top) / frame.height;
    for (const axes of all) {
      const found = (axes.surface ? onSurface : onPlane)(axes, x, y, frame);
      if (!found) continue;
      mark.hidden = say.hidden = false;
      mark.style.left = `${100 * found.left}%`;
      mark.style.top = `${100 * found.top}%`;
      say.textContent = found.text;
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
