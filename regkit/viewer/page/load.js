/** The scene of the page: embedded in it, or beside it on its server. */

const FORMAT = 1;

/** Returns the scene's document. @returns {Promise<any>} */
export async function load() {
  const embedded = document.getElementById("scene");
  const scene = embedded ? await unpacked(embedded.textContent) : await fetched();
  embedded?.remove();
  if (scene.format !== FORMAT) {
    throw new Error(
      `This page shows scenes of format ${FORMAT}, and this one has ${scene.format}.`,
    );
  }
  if (scene.recordings.length === 0) throw new Error("There are no recordings in this scene.");
  return scene;
}

async function unpacked(text) {
  const binary = atob(text.trim());
  const bytes = Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).json();
}

async function fetched() {
  if (location.protocol === "file:") throw new Error("There is no scene in this page.");
  const answer = await fetch("scene.json");
  if (!answer.ok) throw new Error(`The scene is not there: ${answer.status} ${answer.statusText}`);
  return answer.json();
}
