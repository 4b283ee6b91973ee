"use strict";
for (const button of document.querySelectorAll("[data-copy]"))
  button.addEventListener("click", async () => {
    const source = button.previousElementSibling;
    getSelection().selectAllChildren(source); // stays selected where a browser refuses the clipboard
    const done = await navigator.clipboard?.writeText(button.dataset.text ?? source.textContent).then(() => true, () => false);
    button.textContent = done ? "Copied" : "Selected: press Ctrl+C";
  });
