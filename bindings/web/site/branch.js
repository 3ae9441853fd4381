// The branch of steady states of a scene, in a thread of its own.
import init, { branch_of } from "./motile.js";

onmessage = async ({ data: { scene, id } }) => {
  await init();
  try {
    branch_of(scene, (activity, speed, stable, line) => {
      postMessage({ id, activity, speed, stable, line });
      return true;
    });
    postMessage({ id, done: true });
  } catch (error) {
    postMessage({ id, done: true, error: String(error) });
  }
};
