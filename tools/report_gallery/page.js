// A click enlarges a picture; arrow keys go to the next one, so that two can be compared in place.
const dialog = document.querySelector("dialog");
const large = dialog.querySelector("img");
const words = dialog.querySelector("p");
const buttons = [...document.querySelectorAll("figure button")];
let shown = 0;

function show(index) {
    shown = (index + buttons.length) % buttons.length;
    const image = buttons[shown].querySelector("img");
    large.src = image.src;
    large.alt = image.alt;
    words.textContent = image.alt;
    if (!dialog.open) dialog.showModal();
}

buttons.forEach((button, index) => button.addEventListener("click", () => show(index)));
dialog.addEventListener("click", () => dialog.close());
dialog.addEventListener("keydown", (event) => {
    if (event.key === "ArrowRight") show(shown + 1);
    if (event.key === "ArrowLeft") show(shown - 1);
});
