// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

function actionsOf(page) {
  const pan = (key) => () => page.input.panByArrow(key);
  const step = (count) => () => page.player.step(count);
  return {
    "+": () => page.input.closer(), "=": () => page.input.closer(), "-": () => page.input.farther(),
    f: () => page.fit(), l: () => page.toggleFollow(), n: () => page.toggleHeadingUp(), m: () => page.toggleMeasure(),
    t: () => page.theme.toggle(), p: () => page.togglePanel(), " ": () => page.player.togglePlay(),
    ",": step(-1), ".": step(1), j: () => page.player.skip(-10), k: () => page.player.skip(10),
    home: () => page.player.seek(0), end: () => page.player.goLive(), escape: () => page.measure && page.toggleMeasure(),
    arrowleft: pan("ArrowLeft"), arrowright: pan("ArrowRight"), arrowup: pan("ArrowUp"), arrowdown: pan("ArrowDown"),
  };
}

/// The keyboard, wherever the focus is but in what takes keys itself.
export function connectKeys(page) {
  const actions = actionsOf(page);
  document.addEventListener("keydown", (event) => {
    const takesIt = event.key === " " ? "select, input, textarea, button" : "select, input:not([type=checkbox]), textarea";
    if (event.target.closest?.(takesIt) || event.ctrlKey || event.metaKey || event.altKey) return;
    if (/^[1-9]$/.test(event.key)) return page.boxes.toggle(Number(event.key));
    const act = actions[event.key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act();
    page.redraw();
  });
}
