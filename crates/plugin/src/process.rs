//! A child process that answers each line with a line, with protection against misbehavior.
//!
//! Separate threads write to it and read from it, so that a timeout also applies to a process that
//! neither reads nor writes. Its output lines are limited in length; of its standard error the end
//! is kept.

use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use super::group::ProcessGroup;
use super::message::brief_end;

/// The number of bytes kept from its standard error.
const COMPLAINT: usize = 4096;
/// The time for a process that has closed its output to end by itself, so that its exit status can
/// be reported.
const LAST_WORDS: Duration = Duration::from_millis(200);

/// A running process.
#[derive(Debug)]
pub(super) struct Process {
    child: ProcessGroup,
    requests: Sender<(String, usize)>,
    lines: Receiver<Line>,
    complaint: Arc<Mutex<VecDeque<u8>>>,
}

/// Why there is no answer line.
#[derive(Debug)]
pub(super) enum Trouble {
    /// The process has ended.
    Ended(String),
    /// It runs but is unreliable.
    Other(String),
}

impl Trouble {
    pub fn in_words(self) -> String {
        match self {
            Trouble::Ended(words) | Trouble::Other(words) => words,
        }
    }
}

/// A line of output, or why there is none.
#[derive(Debug)]
enum Line {
    Whole(Vec<u8>),
    /// A line with further output after it that was not requested.
    Several,
    TooLong,
    Closed,
}

impl Process {
    /// Runs a command; the error says why that is impossible.
    pub fn start(words: &[String]) -> Result<Process, String> {
        let (program, arguments) = words.split_first().ok_or("no command")?;
        let mut command = Command::new(program);
        command.args(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let cannot = |cause| format!("{program} cannot be run: {cause}");
        let mut child = ProcessGroup::spawn(&mut command).map_err(cannot)?;
        let (Some(mut input), Some(output), Some(error)) =
            (child.stdin.take(), child.stdout.take(), child.stderr.take())
        else {
            return Err(format!("{program} has no pipes"));
        };
        let (requests, to_write) = channel::<(String, usize)>();
        let (longest, lengths) = channel();
        thread::spawn(move || {
            for (request, length) in to_write {
                let sent = longest.send(length).is_ok();
                if !sent
                    || input.write_all(request.as_bytes()).and_then(|()| input.flush()).is_err()
                {
                    break;
                }
            }
        });
        let (send, lines) = sync_channel(1);
        thread::spawn(move || read_lines(BufReader::new(output), &lengths, &send));
        let complaint = Arc::new(Mutex::new(VecDeque::new()));
        let kept = Arc::clone(&complaint);
        thread::spawn(move || keep_end(error, &kept));
        Ok(Process { child, requests, lines, complaint })
    }

    /// The line that follows a request, of at most `longest` bytes and within a time limit; or why
    /// there is none.
    pub fn ask(
        &mut self,
        request: &str,
        longest: usize,
        limit: Duration,
    ) -> Result<Vec<u8>, Trouble> {
        let other = |words: String| Err(Trouble::Other(words));
        if self.requests.send((request.to_string(), longest)).is_err() {
            return Err(Trouble::Ended(self.ended()));
        }
        match self.lines.recv_timeout(limit) {
            Ok(Line::Whole(line)) => Ok(line),
            Ok(Line::Several) => other("it answers with more than one line".into()),
            Ok(Line::TooLong) => other(format!("its answer is longer than {longest} bytes")),
            Ok(Line::Closed) | Err(RecvTimeoutError::Disconnected) => {
                Err(Trouble::Ended(self.ended()))
            }
            Err(RecvTimeoutError::Timeout) => {
                other(format!("no answer within its time limit of {} s", limit.as_secs_f64()))
            }
        }
    }

    /// How it ended, with the end of its standard error.
    fn ended(&mut self) -> String {
        thread::sleep(LAST_WORDS);
        let status = match self.child.try_wait() {
            Ok(Some(status)) => format!("it ended ({status})"),
            _ => "it closed its output".to_string(),
        };
        let mut kept = self.complaint.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(kept.make_contiguous()).into_owned();
        match text.lines().rev().find(|line| !line.trim().is_empty()) {
            Some(last) => format!("{status}: {}", brief_end(last.trim())),
            None => status,
        }
    }
}

/// Sends a line for each requested maximum length, until there are no more requests.
fn read_lines(
    mut output: BufReader<impl Read>,
    lengths: &Receiver<usize>,
    send: &SyncSender<Line>,
) {
    for longest in lengths {
        let mut line = Vec::new();
        let most = longest as u64 + 1;
        let line = match output.by_ref().take(most).read_until(b'\n', &mut line) {
            Ok(0) | Err(_) => Line::Closed,
            Ok(count) if count > longest => Line::TooLong,
            Ok(_) if !output.buffer().is_empty() => Line::Several,
            Ok(_) => Line::Whole(line),
        };
        let is_last = !matches!(line, Line::Whole(_));
        if send.send(line).is_err() || is_last {
            return;
        }
    }
}

/// Reads everything and keeps the end.
fn keep_end(mut error: impl Read, kept: &Mutex<VecDeque<u8>>) {
    let mut part = [0; 1024];
    while let Ok(count @ 1..) = error.read(&mut part) {
        let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.extend(&part[..count]);
        let surplus = kept.len().saturating_sub(COMPLAINT);
        kept.drain(..surplus);
    }
}
