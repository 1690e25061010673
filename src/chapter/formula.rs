//! Typesets the formulas of a plain text: `so A x = b` becomes `so $A x = b$`.

use crate::report::page::markup::literal;

/// Signs of a formula and their LaTeX.
const SIGNS: [(char, &str); 32] = [
    ('−', "-"),
    ('·', "\\cdot "),
    ('×', "\\times "),
    ('⊗', "\\otimes "),
    ('≥', "\\ge "),
    ('≤', "\\le "),
    ('→', "\\to "),
    ('≠', "\\ne "),
    ('½', "\\tfrac12 "),
    ('∂', "\\partial "),
    ('∞', "\\infty "),
    ('Σ', "\\sum "),
    ('Π', "\\Pi "),
    ('Δ', "\\Delta "),
    ('α', "\\alpha "),
    ('β', "\\beta "),
    ('γ', "\\gamma "),
    ('ε', "\\varepsilon "),
    ('θ', "\\theta "),
    ('λ', "\\lambda "),
    ('μ', "\\mu "),
    ('π', "\\pi "),
    ('ρ', "\\rho "),
    ('τ', "\\tau "),
    ('φ', "\\varphi "),
    ('ω', "\\omega "),
    ('ċ', "\\dot c "),
    ('*', "^*"),
    ('=', "="),
    ('+', "+"),
    ('<', "<"),
    ('>', ">"),
];
const RAISED: (&str, &str) = ("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁽⁾ⁿᵏⁱᵀ", "0123456789+-()nkiT");
const LOWERED: (&str, &str) = ("₀₁₂₃₄₅₆₇₈₉₊₋ₙₖᵢⱼ", "0123456789+-nkij");
const RELATIONS: [&str; 13] = ["=", "+", "−", "·", "×", "⊗", "≥", "≤", "<", ">", "→", "≠", "/"];
/// Words that occur as quantities.
const QUANTITIES: [&str; 2] = ["lower", "upper"];
/// What ends a formula, or a part of it.
const ENDS: [char; 4] = [',', '.', ';', ':'];

/// The role of a word in a formula.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    /// None.
    Word,
    /// A letter or a number, which can also belong to a sentence.
    Operand,
    /// It occurs only in formulas.
    Formula,
    /// It connects operands.
    Relation,
}

/// The text as markup, with its formulas in LaTeX.
///
/// ```
/// use lcplab::chapter::formula::typeset;
///
/// assert_eq!(typeset("so A x = b, or not"), "so $A x = b$, or not");
/// assert_eq!(typeset("|b − A x| / |b| of K&M"), "$|b - A x| / |b|$ of K\\&M");
/// assert_eq!(typeset("xₙ₊₁ = vₙ₊₁ + a dt"), "$x_{n+1} = v_{n+1} + a dt$");
/// assert_eq!(typeset("a 6m × n matrix, J_ij"), "a $6m \\times  n$ matrix\\, $J_{ij}$");
/// assert_eq!(typeset("J_ω ω"), "$J_{\\omega} \\omega$");
/// ```
pub fn typeset(text: &str) -> String {
    let words: Vec<&str> = text.split(' ').collect();
    let mut parts = Vec::new();
    let mut at = 0;
    while at < words.len() {
        let length = (1..=words.len() - at).take_while(|n| goes_on(&words[at..at + n])).count();
        let run = (1..=length).rev().find(|n| is_formula(&words[at..at + n]));
        match run {
            Some(n) => {
                let formula = words[at..at + n].join(" ");
                let end = formula.trim_end_matches(ENDS);
                parts.push(format!("${}${}", latex(end).trim_end(), &formula[end.len()..]));
                at += n;
            }
            None => {
                parts.push(literal(words[at]));
                at += 1;
            }
        }
    }
    parts.join(" ")
}

/// Whether these words can be the beginning of a formula: no word of a sentence, and no end before
/// the last one outside of brackets.
fn goes_on(words: &[&str]) -> bool {
    let (last, before) = words.split_last().expect("at least one word");
    let open = depth(&before.join(" "));
    let ended = before.last().is_some_and(|word| word.ends_with(ENDS));
    role(last) != Role::Word && (!ended || open > 0)
}

/// Whether these words are a whole formula.
fn is_formula(words: &[&str]) -> bool {
    let roles: Vec<Role> = words.iter().map(|word| role(word)).collect();
    let has = |wanted: Role| roles.contains(&wanted);
    let is_whole =
        roles.last() != Some(&Role::Relation) && (roles[0] != Role::Relation || words[0] == "−");
    let text = words.join(" ");
    let has_article = words[0] == "a" && roles.get(1) != Some(&Role::Relation);
    is_whole
        && !has_article
        && (has(Role::Formula) || (has(Role::Relation) && has(Role::Operand)))
        && depth(&text) == 0
        && text.matches('|').count().is_multiple_of(2)
}

/// The number of open brackets; -1 if one is closed that was not opened.
fn depth(text: &str) -> i32 {
    text.chars().fold(0, |depth: i32, c| match c {
        _ if depth < 0 => depth,
        '(' | '[' => depth + 1,
        ')' | ']' => depth - 1,
        _ => depth,
    })
}

fn role(word: &str) -> Role {
    if RELATIONS.contains(&word) {
        return Role::Relation;
    }
    let core = word.trim_end_matches(ENDS);
    if QUANTITIES.contains(&core) {
        return Role::Operand;
    }
    let runs = core.split(|c: char| !c.is_ascii_alphabetic());
    let is_sentence = runs.clone().any(|run| run.len() > 1 && !is_symbols(run, core));
    let is_known = |c: char| {
        c.is_ascii_alphanumeric()
            || "()[]|/.,;_'\u{307}".contains(c)
            || is_special(c)
            || SIGNS.iter().any(|(sign, _)| *sign == c)
    };
    if core.is_empty() || is_sentence || !core.chars().all(is_known) {
        return Role::Word;
    }
    let is_sign = |c: char| !c.is_ascii() && c != '−';
    match core.contains('_') || core.chars().any(is_sign) {
        true => Role::Formula,
        false if core.chars().any(|c| c.is_ascii_alphanumeric()) => Role::Operand,
        false => Role::Word,
    }
}

/// Whether letters of a word are symbols: `dt`, or indices as in `J_ij`.
fn is_symbols(run: &str, word: &str) -> bool {
    run == "dt" || word.contains(&format!("_{run}"))
}

fn is_special(c: char) -> bool {
    RAISED.0.contains(c) || LOWERED.0.contains(c)
}

fn latex(formula: &str) -> String {
    let mut out = String::new();
    let mut rest = formula;
    if let Some(word) = QUANTITIES.iter().find(|word| formula.contains(*word)) {
        let (before, after) = formula.split_once(word).unwrap_or_default();
        return format!("{}\\text{{{word}}}{}", latex(before), latex(after));
    }
    while let Some(c) = rest.chars().next() {
        let after = &rest[c.len_utf8()..];
        let dotted = after.strip_prefix('\u{307}');
        rest = match (c, dotted) {
            (_, Some(after)) => {
                out += &format!("\\dot{{{c}}}");
                after
            }
            ('_', _) => {
                let is_index = |c: char| c.is_alphanumeric() && c != '½' && !is_special(c);
                let end = after.find(|c: char| !is_index(c)).unwrap_or(after.len());
                out += &format!("_{{{}}}", latex(&after[..end]).trim_end());
                &after[end..]
            }
            (c, _) if is_special(c) => {
                let (sign, (from, to)) =
                    if RAISED.0.contains(c) { ('^', RAISED) } else { ('_', LOWERED) };
                let end = rest.find(|c: char| !from.contains(c)).unwrap_or(rest.len());
                let moved = |c: char| from.chars().zip(to.chars()).find(|pair| pair.0 == c);
                let moved: String = rest[..end].chars().filter_map(moved).map(|p| p.1).collect();
                out += &format!("{sign}{{{moved}}}");
                &rest[end..]
            }
            (c, _) => {
                let sign = SIGNS.iter().find(|(sign, _)| *sign == c);
                match sign {
                    Some((_, latex)) => out += latex,
                    None => out.push(c),
                }
                after
            }
        };
    }
    out
}
