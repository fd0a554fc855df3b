/** Starts the page, or tells why it cannot. */

import { load } from "./load.js";
import { Page } from "./page.js";
import { NoWebGL, Stage } from "./stage.js";

/** Returns where the scene is drawn, or null with a message in its place. */
function stageOrMessage() {
  try {
    return new Stage(document.getElementById("view"));
  } catch (error) {
    if (!(error instanceof NoWebGL)) throw error;
    message(
      "This browser offers no WebGL, so the scene cannot be drawn. " +
        "The verdicts and values of each frame are beside and below.",
    );
    return null;
  }
}

function message(text) {
  const place = document.getElementById("message");
  place.textContent = text;
  place.hidden = false;
}

try {
  new Page(await load(), stageOrMessage());
} catch (error) {
  message(error.message);
  document.documentElement.dataset.failed = error.stack;
}
