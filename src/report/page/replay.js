"use strict";
for (const box of document.querySelectorAll(".replay")) {
  const motion = JSON.parse(box.querySelector("script").textContent);
  const unpacked = (text) => {
    const numbers = [];
    for (let i = 0; i < text.length; i += 1) {
      if (text[i] === "!") {
        const end = text.indexOf(";", i);
        numbers.push(Number(text.slice(i + 1, end)));
        i = end;
      } else numbers.push(text.charCodeAt(i) - 93);
    }
    return numbers;
  };
  const summed = (lists) => {
    let now = [];
    return lists.map((text) => {
      if (text === " ") return now;
      const list = unpacked(text);
      now = list.length === now.length ? list.map((by, i) => now[i] + by) : list;
      return now;
    });
  };
  const shapes = motion.shapes.map((rings) => rings.map(summed));
  const places = summed(motion.places);
  const fills = box.querySelectorAll(".field path");
  const parts = [...box.querySelectorAll("svg > path")].slice(0, shapes.length);
  const line = (ring) => {
    let text = "";
    for (let i = 0; i < ring.length; i += 2) text += `${i ? "L" : "M"}${ring[i]} ${ring[i + 1]}`;
    return text && text + "Z";
  };
  const [button, slider, time] = ["button", "input", "output"].map((name) => box.querySelector(name));
  const last = motion.ms.length - 1;
  slider.max = last;

  const show = (frame) => {
    const at = places[frame];
    parts.forEach((path, part) => path.setAttribute("d", shapes[part].map((ring) => line(ring[frame])).join("")));
    const cells = Array(fills.length).fill("");
    [...motion.steps[frame]].forEach((step, cell) => {
      const corners = motion.cells.slice(4 * cell, 4 * cell + 4);
      cells[parseInt(step, 36)] += line(corners.flatMap((node) => [at[2 * node], at[2 * node + 1]]));
    });
    fills.forEach((path, step) => path.setAttribute("d", cells[step]));
    slider.value = frame;
    time.textContent = `${motion.ms[frame].toFixed(3)} ms`;
    box.dataset.frame = frame;
  };

  let timer = null;
  const stop = () => {
    clearInterval(timer);
    timer = null;
    button.textContent = "Play";
  };
  const play = () => {
    if (Number(slider.value) >= last) show(0);
    timer = setInterval(() => {
      const next = Number(slider.value) + 1;
      if (next > last) stop();
      else show(next);
    }, 60);
    button.textContent = "Pause";
  };
  button.addEventListener("click", () => (timer ? stop() : play()));
  slider.addEventListener("input", () => {
    stop();
    show(Number(slider.value));
  });
  addEventListener("beforeprint", () => {
    stop();
    show(motion.peak);
  });
  show(motion.peak);
  // A link that ends in #play begins at once.
  if (location.hash === "#play") {
    show(0);
    play();
  }
}
