// Typesets the formulas of the page with KaTeX. Sphinx writes them as \(...\) and \[...\].
for (const formula of document.querySelectorAll('.math')) renderMathInElement(formula);
