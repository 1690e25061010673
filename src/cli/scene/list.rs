//! `scenes`: lists the shipped scenes, and the fields of the scene format.

use clap::Args;
use lcplab::constraint;
use lcplab::error::{Error, Result};
use lcplab::scene::{Description, catalogue};
use serde_json::json;

use crate::cli::{Outcome, print};

/// List the shipped scenes, or print one
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab scenes
  lcplab scenes pendulum > mine.toml   # start your own scene from this one
  lcplab scenes stack --json           # every body in full, for another program
  lcplab scenes --joints               # the constraints that a scene can have")]
pub struct Scenes {
    /// Print this scene's file
    name: Option<String>,
    /// Print a shipped scene or a scene file as JSON in full: each body of a structure, gravity
    /// instead of a tilt, and every mass, moment of inertia, quaternion and coefficient
    #[arg(long, requires = "name")]
    json: bool,
    /// Print the JSON schema of the scene format
    #[arg(long, conflicts_with = "name")]
    schema: bool,
    /// List the constraints that a scene can have, with their fields
    #[arg(long, conflicts_with_all = ["name", "schema"])]
    joints: bool,
}

impl Scenes {
    pub fn run(&self) -> Result<Outcome> {
        if self.schema {
            print(&format!("{}\n", lcplab::scene::schema()))?;
            return Ok(Outcome::Good);
        }
        if self.joints {
            constraint::ALL.iter().try_for_each(|joint| print(&format!("{joint}\n")))?;
            return Ok(Outcome::Good);
        }
        if let (Some(name), true) = (&self.name, self.json) {
            let scene = Description::load_with(name, &[])?.written_out(name)?;
            print(&format!("{}\n", json!(scene)))?;
            return Ok(Outcome::Good);
        }
        if let Some(name) = &self.name {
            let known = || catalogue::SHIPPED.iter().map(|shipped| shipped.name.into()).collect();
            let file = catalogue::text(name).ok_or_else(|| Error::Unknown {
                kind: "shipped scene",
                name: name.clone(),
                known: known(),
            })?;
            print(file)?;
            return Ok(Outcome::Good);
        }
        let mut list = String::new();
        for shipped in catalogue::SHIPPED {
            list += &format!("{:<16} {}\n", shipped.name, shipped.scene()?.title);
        }
        print(&list)?;
        Ok(Outcome::Good)
    }
}
