//! Formulas in Unicode.

use lcplab_page::document::unicode;

#[test]
fn formulas_become_letters_and_words_stay() {
    for (markdown, text) in [
        (r"a speed $\dot c = J u$ of 2 m/s", "a speed c\u{307} = J u of 2 m/s"),
        (r"$\tfrac12 x^T A x$, $\tfrac23$", "½ xᵀ A x, ⅔"),
        (r"$J = [n_1^T,\ n_2^T]$", "J = [n₁ᵀ, n₂ᵀ]"),
        (r"$\begin{bmatrix} 2 & -1 \\ -1 & 2 \end{bmatrix}$", "[2, -1; -1, 2]"),
        (r"$\omega \ge (1/\sin 45°)^{1/2}$", "ω ≥ (1/sin 45°)^(1/2)"),
        (r"$|x_t| \le \mu\,x_n$", "|xₜ| ≤ μ xₙ"),
        (r"$\frac{a + b}{2 c}$ and $\sqrt{2}$", "(a + b)/(2 c) and √2"),
        (r"$v\,(1 - s^2,\ s\sqrt{1 - s^2})$", "v (1 - s², s√(1 - s²))"),
        (r"$\Omega^2 l - \mu g \tau$", "Ω² l - μ g τ"),
        ("10 % of $b$", "10 % of b"),
    ] {
        assert_eq!(unicode(markdown), text);
    }
}
