// Draws the formulas of the page with KaTeX. Sphinx leaves them as \(...\) and \[...\].
document.addEventListener('DOMContentLoaded', () => {
  for (const element of document.querySelectorAll('.math')) renderMathInElement(element);
});
