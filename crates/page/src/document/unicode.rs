//! Markdown with formulas in Unicode, for terminals and cells of tables: `$\tfrac12 x^T A x$`
//! becomes `½ xᵀ A x`.

/// The symbols of commands.
const SYMBOLS: [(&str, &str); 32] = [
    ("cdot", "·"),
    ("times", "×"),
    ("otimes", "⊗"),
    ("ge", "≥"),
    ("le", "≤"),
    ("pm", "±"),
    ("leftarrow", "←"),
    ("to", "→"),
    ("sum", "Σ"),
    ("partial", "∂"),
    ("infty", "∞"),
    ("dots", "…"),
    ("ldots", "…"),
    ("quad", "  "),
    ("qquad", "  "),
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("varepsilon", "ε"),
    ("zeta", "ζ"),
    ("theta", "θ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("pi", "π"),
    ("Pi", "Π"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("varphi", "φ"),
    ("omega", "ω"),
    ("Omega", "Ω"),
];
const RAISED: (&str, &str) = ("0123456789+-()nkTij*", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁽⁾ⁿᵏᵀⁱʲ*");
const LOWERED: (&str, &str) = ("0123456789+-nktij", "₀₁₂₃₄₅₆₇₈₉₊₋ₙₖₜᵢⱼ");
const HALVES: [(&str, &str); 6] =
    [("1/2", "½"), ("1/3", "⅓"), ("2/3", "⅔"), ("1/4", "¼"), ("3/4", "¾"), ("1/8", "⅛")];

/// The text with its formulas in Unicode.
///
/// ```
/// use lcplab_page::document::unicode;
///
/// assert_eq!(unicode(r"a body with $x_1 \ge 0$"), "a body with x₁ ≥ 0");
/// ```
pub fn unicode(markdown: &str) -> String {
    let words = markdown.replace("$$", "$");
    let pieces = words.split('$').enumerate();
    pieces.map(|(k, piece)| if k % 2 == 0 { piece.to_string() } else { formula(piece) }).collect()
}

/// A formula without its dollar signs.
fn formula(latex: &str) -> String {
    let mut rest = latex;
    let mut out = String::new();
    while let Some(c) = rest.chars().next() {
        let after = &rest[c.len_utf8()..];
        rest = match c {
            '\\' => command(after, &mut out),
            '^' | '_' => {
                let (script, after) = argument(after);
                out += &moved(&formula(script), if c == '^' { RAISED } else { LOWERED }, c);
                after
            }
            '{' | '}' => after,
            '&' => {
                out.truncate(out.trim_end().len());
                out.push(',');
                after
            }
            c => {
                out.push(c);
                after
            }
        };
    }
    out
}

/// Converts what begins with a backslash; returns the rest.
fn command<'a>(rest: &'a str, out: &mut String) -> &'a str {
    let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
    let (name, after) = rest.split_at(end);
    match name {
        "" if rest.starts_with('\\') => {
            out.truncate(out.trim_end().len());
            out.push(';');
            &rest[1..]
        }
        "" => {
            out.push(' ');
            rest.get(1..).unwrap_or("")
        }
        "begin" => {
            out.push('[');
            argument(after).1.trim_start()
        }
        "end" => {
            out.truncate(out.trim_end().len());
            out.push(']');
            argument(after).1
        }
        "left" | "right" => after,
        "mathrm" | "text" => {
            let (word, after) = argument(after);
            *out += word;
            after
        }
        "frac" | "tfrac" => {
            let (above, after) = argument(after);
            let (below, after) = argument(after);
            let quotient = format!("{}/{}", grouped(above), grouped(below));
            let known = HALVES.iter().find(|(long, _)| *long == quotient);
            *out += known.map_or(quotient.as_str(), |(_, short)| short);
            after
        }
        "sqrt" => {
            let (inside, after) = argument(after);
            *out += &format!("√{}", grouped(inside));
            after
        }
        "dot" | "ddot" | "hat" => {
            let (letter, after) = argument(after);
            let mark = [("dot", '\u{307}'), ("ddot", '\u{308}'), ("hat", '\u{302}')];
            *out += &formula(letter);
            out.extend(mark.iter().filter(|own| own.0 == name).map(|own| own.1));
            after
        }
        "Delta" => {
            out.push('Δ');
            after.trim_start()
        }
        name => {
            let known = SYMBOLS.iter().find(|own| own.0 == name);
            // cos, sin and min remain words.
            *out += known.map_or(name, |own| own.1);
            after
        }
    }
}

/// The next character or group, and the rest.
fn argument(rest: &str) -> (&str, &str) {
    let rest = rest.trim_start();
    if let Some(inside) = rest.strip_prefix('{') {
        let mut depth = 1;
        for (at, c) in inside.char_indices() {
            depth += i32::from(c == '{') - i32::from(c == '}');
            if depth == 0 {
                return (&inside[..at], &inside[at + 1..]);
            }
        }
    }
    let first = match rest.strip_prefix('\\') {
        Some(name) => 1 + name.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(name.len()),
        None => rest.chars().next().map_or(0, char::len_utf8),
    };
    rest.split_at(first)
}

/// LaTeX with the superscripts and subscripts of a text; the inverse of [`moved`].
pub(super) fn scripted(text: &str) -> String {
    let plain = |c: char, (plain, other): (&str, &str)| {
        plain.chars().nth(other.chars().position(|own| own == c)?)
    };
    let one = |c: char| match (plain(c, RAISED), plain(c, LOWERED)) {
        (Some(c), _) => format!("^{{{c}}}"),
        (_, Some(c)) => format!("_{{{c}}}"),
        _ => c.to_string(),
    };
    // Neighbors share a script.
    let latex: String = text.chars().map(one).collect();
    latex.replace("}^{", "").replace("}_{", "")
}

/// A part of a quotient or a root, in parentheses if it is a sum.
fn grouped(latex: &str) -> String {
    let text = formula(latex);
    if text.contains([' ', '+', '-']) { format!("({text})") } else { text }
}

/// Superscript or subscript if Unicode has all characters; otherwise with the sign before it.
fn moved(text: &str, (plain, other): (&str, &str), sign: char) -> String {
    let place = |c: char| plain.chars().position(|own| own == c);
    let all: Option<String> =
        text.chars().map(|c| place(c).and_then(|at| other.chars().nth(at))).collect();
    let is_word = text.chars().all(char::is_alphabetic);
    all.unwrap_or_else(|| if is_word { format!("{sign}{text}") } else { format!("{sign}({text})") })
}
