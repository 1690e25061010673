//! The little markup of a page's text.
//!
//! ```text
//! an empty line   starts a paragraph         *word*          emphasis
//! - item          an item of a list          **word**        strong emphasis
//! `word`          code                       [word](address) a link
//! $x^2$           mathematics (LaTeX)        \*              the sign itself
//! ```

use std::fmt::Write;

use math_core::{LatexToMathML, MathDisplay};

/// Text with every sign that means something in HTML replaced.
pub fn html(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

/// Text that reads as itself where markup is understood, whatever signs it has.
pub fn literal(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if SIGNS.contains(c) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

const SIGNS: &str = "\\`$*[]-";

/// Turns markup into HTML and equations into MathML. An error is a sentence that quotes the
/// offending piece.
#[derive(Default)]
pub(super) struct Renderer {
    math: LatexToMathML,
}

impl Renderer {
    /// Paragraphs and lists.
    pub fn blocks(&self, text: &str) -> Result<String, String> {
        let mut out = String::new();
        for block in text.split("\n\n").map(str::trim).filter(|block| !block.is_empty()) {
            if let Some(list) = block.strip_prefix("- ") {
                out.push_str("<ul>\n");
                for item in list.split("\n- ") {
                    let _ = writeln!(out, "<li>{}</li>", self.inline(item)?);
                }
                out.push_str("</ul>\n");
            } else {
                let _ = writeln!(out, "<p>{}</p>", self.inline(block)?);
            }
        }
        Ok(out)
    }

    /// Text within a line.
    pub fn inline(&self, text: &str) -> Result<String, String> {
        let mut out = String::new();
        let mut rest = text;
        while let Some(at) = rest.find(['\\', '`', '$', '*', '[']) {
            out.push_str(&html(&rest[..at]));
            rest = &rest[at..];
            let (markup, after) = self.piece(rest)?;
            out.push_str(&markup);
            rest = after;
        }
        out.push_str(&html(rest));
        Ok(out)
    }

    /// A displayed equation.
    pub fn equation(&self, latex: &str) -> Result<String, String> {
        self.mathml(latex, MathDisplay::Block)
    }

    /// The piece of markup at the start of the text, as HTML, and what comes after it.
    fn piece<'a>(&self, text: &'a str) -> Result<(String, &'a str), String> {
        let (sign, body) = text.split_at(1);
        let unclosed = || format!("a {sign} without its partner: {:?}", shortened(text));
        match sign {
            "\\" => {
                let escaped = body.chars().next().filter(|c| SIGNS.contains(*c));
                let sign = escaped.map_or("\\".into(), |c| html(&c.to_string()));
                Ok((sign, &body[escaped.map_or(0, char::len_utf8)..]))
            }
            "`" => {
                let (code, after) = body.split_once('`').ok_or_else(unclosed)?;
                Ok((format!("<code>{}</code>", html(code)), after))
            }
            "$" => {
                let (latex, after) = body.split_once('$').ok_or_else(unclosed)?;
                Ok((self.mathml(latex, MathDisplay::Inline)?, after))
            }
            "[" => match link(body) {
                Some((words, address, after)) => {
                    let words = self.inline(words)?;
                    Ok((format!("<a href=\"{}\">{words}</a>", html(safe(address)?)), after))
                }
                None => Ok(("[".into(), body)),
            },
            _ => {
                let (mark, tag) =
                    if body.starts_with('*') { ("**", "strong") } else { ("*", "em") };
                let body = &text[mark.len()..];
                match body.split_once(mark) {
                    // A star before a space, or without a partner, is a star: `x* - y`.
                    Some((words, after)) if starts_word(words) => {
                        Ok((format!("<{tag}>{}</{tag}>", self.inline(words)?), after))
                    }
                    _ => Ok((mark.into(), body)),
                }
            }
        }
    }

    fn mathml(&self, latex: &str, display: MathDisplay) -> Result<String, String> {
        let converted = self.math.convert_with_local_state(latex, display);
        converted.map(|result| result.mathml).map_err(|error| {
            let mut reason = String::new();
            error.to_message(&mut reason, latex);
            format!("the equation {latex:?} at character {reason}")
        })
    }
}

fn link(text: &str) -> Option<(&str, &str, &str)> {
    let (words, rest) = text.split_once("](")?;
    let (address, after) = rest.split_once(')')?;
    (!words.contains(['[', '\n'])).then_some((words, address, after))
}

/// The address, unless it could run something or is none.
fn safe(address: &str) -> Result<&str, String> {
    let scheme = address.split(['/', '#', '?']).next().and_then(|start| start.split_once(':'));
    match scheme {
        None | Some(("https" | "http" | "mailto", _)) if !address.is_empty() => Ok(address),
        _ => Err(format!("the link {address:?} is neither a web address nor a relative one")),
    }
}

fn starts_word(text: &str) -> bool {
    text.chars().next().is_some_and(|c| !c.is_whitespace())
}

fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}
