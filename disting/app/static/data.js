// Data page: what was read of a file, before anything is fitted.
export const start = (root) => {
  const title = document.createElement("h1");
  title.textContent = "Data";
  root.append(title);
};
