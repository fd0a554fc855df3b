/** The line above the scene: its title, its recordings, and what its maker says of it. */

const $ = (id) => document.getElementById(id);

/**
 * Shows the heading of a scene.
 * @param {any} scene The scene's document.
 * @param {(name: string) => void} chosen Called with the recording that the reader chose.
 */
export function showHeading({ title, note, recordings, live }, chosen) {
  document.title = title;
  $("title").textContent = title;
  $("note").textContent = note;
  $("live").hidden = !live;
  $("recordings").replaceChildren(...recordings.map(({ name }) => new Option(name, name)));
  $("recordings").hidden = recordings.length < 2;
  $("recordings").addEventListener("change", () => chosen($("recordings").value));
}
