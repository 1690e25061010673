//! Reads QPS line by line.

use super::program::Program;
use crate::Input;
use crate::words::{Words, brief};
use lcplab_lcp::error::Result;
use lcplab_lcp::file::Problem;

pub(super) fn read(input: &Input) -> Result<Problem> {
    parse(&input.text()?, &input.name(), input.stem())
}

fn parse(text: &str, input: &str, stem: String) -> Result<Problem> {
    let mut program = Program::new(stem);
    let mut words = Words::new(text, input);
    let (mut section, mut is_over) = (String::new(), false);
    while let Some(line) = words.line() {
        if line.starts_with('*') || line.trim().is_empty() {
            continue;
        }
        if is_over {
            let reason = format!("not understood, after ENDATA: {:?}", brief(line.trim()));
            return Err(words.fault(reason));
        }
        let fields: Vec<&str> = line.split_whitespace().collect();
        if line.starts_with(char::is_whitespace) {
            program.data(&section, &fields).map_err(|reason| words.fault(reason))?;
            continue;
        }
        section = fields[0].to_string();
        is_over = program.section(&fields).map_err(|reason| words.fault(reason))?;
    }
    if !is_over {
        return Err(words.fault("the file ends before ENDATA"));
    }
    program.finish(input)
}
