//! The Python notebook: Python cells with their output, and only the shown output of the Rust
//! cells.

use serde_json::{Value, json};

use super::{code, file, prose};
use crate::document::Block;
use crate::error::Result;
use crate::lesson::record::Output;
use crate::lesson::show::lined;
use crate::lesson::source::{Part, Source};
use crate::lesson::{Program, Record, quoted, twin};
use crate::report::page::base64;

impl Program {
    /// The Python notebook with its outputs, as the text of an `.ipynb` file.
    ///
    /// # Errors
    /// If the prose quotes a value that no cell has put.
    pub fn notebook(&self, record: &Record) -> Result<String> {
        let mut cells = vec![prose(&format!("# {}", self.title()))];
        let mut outputs = record.cells.iter();
        for part in &Source::read(self.text).parts {
            match part {
                Part::Prose(text) => cells.push(self.drawn(&quoted(self, text, record)?)),
                Part::Python { code: text, output, .. } => {
                    let stream = json!({
                        "output_type": "stream", "name": "stdout", "text": lined(output),
                    });
                    let outputs = if output.is_empty() { Vec::new() } else { vec![stream] };
                    cells.push(code(twin::shown(text).trim(), outputs));
                }
                Part::Cell { .. } => {
                    cells.extend(outputs.next().into_iter().flatten().filter_map(shown));
                }
            }
        }
        let metadata = json!({
            "kernelspec": { "display_name": "Python 3", "language": "python", "name": "python3" },
            "language_info": { "file_extension": ".py", "mimetype": "text/x-python", "name": "python" },
        });
        Ok(file(cells, &metadata))
    }

    /// Prose with embedded drawings.
    fn drawn(&self, text: &str) -> Value {
        let (mut text, mut attachments) = (text.to_string(), json!({}));
        for (name, svg) in self.drawings {
            let link = format!("](drawings/{name})");
            if text.contains(&link) {
                text = text.replace(&link, &format!("](attachment:{name})"));
                attachments[*name] = attached(svg);
            }
        }
        let mut cell = prose(&text);
        if attachments != json!({}) {
            cell["attachments"] = attachments;
        }
        cell
    }
}

/// The shown output of a Rust cell; its printed output appears with the equivalent Python cell.
fn shown(output: &Output) -> Option<Value> {
    match output {
        Output::Lines(_) => None,
        Output::Block(Block::Figure(picture)) => {
            let mut cell =
                prose(&format!("![Figure](attachment:figure.svg)\n\n{}", picture.caption));
            cell["attachments"]["figure.svg"] = attached(&picture.svg);
            Some(cell)
        }
        Output::Block(block) => Some(prose(block.markdown().trim())),
    }
}

fn attached(svg: &str) -> Value {
    json!({ "image/svg+xml": base64(without_data(svg).as_bytes()) })
}

/// The picture without the attributes `data-…`, which only a script on a page reads.
fn without_data(svg: &str) -> String {
    let mut kept = String::new();
    for element in svg.split('<').skip(1) {
        let (tag, text) = element.split_once('>').unwrap_or((element, ""));
        let mut attributes = tag.split(" data-");
        kept += "<";
        kept += attributes.next().unwrap_or_default();
        for attribute in attributes {
            kept += attribute.splitn(3, '"').nth(2).unwrap_or_default();
        }
        kept += ">";
        kept += text;
    }
    kept
}
