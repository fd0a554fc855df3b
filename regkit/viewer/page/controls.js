/** Buttons and keys that move the frame and the view. */

const $ = (id) => document.getElementById(id);
const SPEEDS = [0.25, 0.5, 1, 2, 4];
const VIEWS = ["front", "side", "top", "sensor"];

/**
 * @param {import("./player.js").Player} player
 * @param {(view: string) => void} look
 * @param {() => void} changed Called when the speed has changed.
 */
export function controls(player, look, changed) {
  const last = () => player.recording.frames.length - 1;
  const steps = {
    first: () => player.seek(0),
    back: () => player.seek(player.index - 1),
    on: () => player.seek(player.index + 1),
    last: () => player.seek(last()),
    mark: () => player.mark(1),
  };
  for (const button of document.querySelectorAll("[data-step]")) {
    button.addEventListener("click", () => steps[button.dataset.step]());
  }
  for (const button of document.querySelectorAll("[data-view]")) {
    button.addEventListener("click", () => look(button.dataset.view));
  }
  const pace = (speed) => {
    player.speed = speed;
    $("speed").value = String(
      SPEEDS.reduce((a, b) => (Math.abs(b - speed) < Math.abs(a - speed) ? b : a)),
    );
    changed();
  };
  const faster = (by) =>
    pace(
      SPEEDS[
        Math.max(0, Math.min(SPEEDS.indexOf(Number($("speed").value)) + by, SPEEDS.length - 1))
      ],
    );
  $("play").addEventListener("click", () => player.play());
  $("speed").addEventListener("change", () => pace(Number($("speed").value)));
  $("follow").addEventListener("click", () => player.seek(last()));
  $("help").addEventListener("click", () => $("keys").showModal());

  const keys = {
    " ": () => player.play(),
    ArrowLeft: (event) => player.seek(player.index - (event.shiftKey ? 10 : 1)),
    ArrowRight: (event) => player.seek(player.index + (event.shiftKey ? 10 : 1)),
    Home: steps.first,
    End: steps.last,
    m: () => player.mark(1),
    M: () => player.mark(-1),
    "+": () => faster(1),
    "-": () => faster(-1),
    f: () => look("free"),
    "?": () => $("keys").showModal(),
  };
  VIEWS.forEach((view, i) => (keys[i + 1] = () => look(view)));
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || $("keys").open) return;
    // A choice or a button that has the focus keeps the keys that it needs itself.
    const own =
      event.target.closest?.("select") ||
      (event.key === " " && event.target.closest?.("button, input, summary"));
    if (own || !(event.key in keys)) return;
    event.preventDefault();
    keys[event.key](event);
  });
  return { pace };
}

/** Shows what plays and from where it is seen. */
export function showControls(player, view) {
  const { playing, recording } = player;
  $("play").toggleAttribute("data-playing", playing);
  $("play").setAttribute("aria-label", playing ? "Pause" : "Play");
  $("play").disabled = recording.frames.length < 2;
  $("mark").hidden = recording.marks.length === 0;
  $("follow").setAttribute("aria-pressed", player.following);
  for (const button of document.querySelectorAll("[data-view]")) {
    button.setAttribute("aria-pressed", button.dataset.view === view?.name);
  }
  // The border of the depth camera's picture, where the scene is seen as it sees it.
  $("border").hidden = !view?.sensor;
  if (view?.sensor) Object.assign($("border").style, view.border);
}
