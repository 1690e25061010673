//! `--plugin`: someone else's program as a solver.

use std::time::Duration;

use clap::Args;
use lcplab::error::{Error, Result};
use lcplab::plugin::Plugin;

/// Programs that solve problems.
#[derive(Debug, Args)]
pub struct Plugins {
    /// A command that reads problems and writes answers, as docs/plugins.md says: "python3 mine.py" is
    /// named mine, "NAME=COMMAND" as it says; may be given more than once
    #[arg(long, value_name = "COMMAND")]
    plugin: Vec<String>,
    /// An answer of a plug-in must come within so many seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    plugin_time_limit: f64,
}

impl Plugins {
    /// Starts them; each ends when it is dropped.
    pub fn start(&self) -> Result<Vec<Plugin>> {
        let seconds = self.plugin_time_limit;
        let limit = Duration::try_from_secs_f64(seconds).ok().filter(|limit| !limit.is_zero());
        let Some(limit) = limit else {
            let reason = format!("must be above 0, is {seconds}");
            return Err(Error::invalid("options", "--plugin-time-limit", reason));
        };
        self.plugin.iter().map(|spec| Plugin::start(spec, limit)).collect()
    }
}
