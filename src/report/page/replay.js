"use strict";
for (const box of document.querySelectorAll(".replay")) {
  const motion = JSON.parse(box.querySelector("script").textContent);
  const summed = (lists) => {
    let now = null;
    return lists.map((list) => (now = now ? list.map((by, i) => now[i] + by) : list));
  };
  const places = summed(motion.places);
  const objects = motion.objects && summed(motion.objects);
  const [object, ...parts] = box.querySelectorAll("path");
  const [button, slider, time] = ["button", "input", "output"].map((name) => box.querySelector(name));
  const last = motion.ms.length - 1;
  slider.max = last;

  const show = (frame) => {
    const at = places[frame];
    parts.forEach((path, part) => {
      const ends = motion.parts[part];
      let lines = "";
      for (let i = 0; i < ends.length; i += 2) {
        const [a, b] = [2 * ends[i], 2 * ends[i + 1]];
        lines += `M${at[a]} ${at[a + 1]}L${at[b]} ${at[b + 1]}`;
      }
      path.setAttribute("d", lines);
    });
    object.setAttribute("d", objects ? `M${objects[frame].join(" ")}Z` : "");
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
