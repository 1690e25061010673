
// A proof is checked by code that knows nothing but its specification.
for (const box of document.querySelectorAll(".proof")) {
  const button = box.querySelector(".check"), output = box.querySelector("output");
  button.hidden = false;
  button.addEventListener("click", () => {
    const problem = box.querySelector(".problem").textContent;
    const start = performance.now();
    const { holds, says } = lcpcheck(problem, box.querySelector("code").textContent);
    const time = Math.max(1, Math.round(performance.now() - start));
    output.textContent = holds ? `Proved: ${says} (${time} ms).` : `Refused: ${says}.`;
    output.className = holds ? "good" : "bad";
  });
}
