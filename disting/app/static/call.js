// Calls of the engine: JSON in, JSON out. A promise that a job returns has `stop`.
export class CallError extends Error {
  constructor(message, status) { super(message); this.status = status; }
}

const post = async (path, body, type = "application/json", signal = undefined) => {
  let response;
  try {
    response = await fetch(path, { method: "POST", headers: { "content-type": type }, body, signal });
  } catch {
    throw new CallError("The app does not answer. Start it again with: disting app", 0);
  }
  const content = await response.json().catch(() => ({ error: "The app gave no answer that this page can read." }));
  if (!response.ok) throw new CallError(content.error, response.status);
  return content;
};

// Progress and answer of a job that runs, by its number.
export const follow = (job, onProgress = () => {}) => {
  const promise = new Promise((resolve, reject) => {
    const events = new EventSource(`/api/jobs/${job}`);
    events.addEventListener("progress", (event) => onProgress(JSON.parse(event.data)));
    events.addEventListener("end", (event) => {
      events.close();
      const { state, message, answer } = JSON.parse(event.data);
      if (state === "done") resolve(answer);
      else reject(new CallError(state === "stopped" ? "Stopped." : message, state === "stopped" ? -1 : 422));
    });
    events.addEventListener("error", () => {
      if (events.readyState === EventSource.CLOSED) reject(new CallError("The app does not answer. Start it again with: disting app", 0));
    });
  });
  promise.stop = () => post(`/api/jobs/${job}/stop`, "");
  return promise;
};

// `call("look", request)`; of a job `onProgress({what, done, total, state})` hears how far it is. `stop` ends a job; `leave` gives up an
// answer that nobody needs any more, and the app then ends what computes it.
export const call = (name, request, onProgress) => {
  const interest = new AbortController(), answered = post(`/api/${name}`, JSON.stringify(request), undefined, interest.signal);
  let running = null, isStopped = false;
  const promise = answered.then((content) => {
    if (!("job" in content)) return content;
    running = follow(content.job, onProgress);
    if (isStopped) running.stop();
    return running;
  });
  promise.stop = () => { isStopped = true; return running?.stop(); };
  promise.leave = () => interest.abort();
  return promise;
};

// Keep a file in the project folder: {name, size}.
export const upload = (file, name = file.name) => post(`/api/upload?name=${encodeURIComponent(name)}`, file, "application/octet-stream");
