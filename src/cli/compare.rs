//! `fastphong compare`: error and speed of every method on one scene, as a table.

use super::engines::LectureFlags;
use super::measured::{How, TimingFlags, command_line};
use super::scene_flags::SceneFlags;
use super::talk::{Talk, to_stdout};
use super::{Failure, Outcome};
use fastphong::compare::comparison::{Comparison, Document, TableKind, table};
use fastphong::compare::timing::Machine;

/// Compare methods on one scene: error against the reference, time, ratios
#[derive(clap::Args, Debug)]
pub struct Compare {
    /// A scene file, a mesh file, builtin:NAME?key=value, or the name of a shipped scene
    input: String,
    #[command(flatten)]
    timing: TimingFlags,
    #[command(flatten)]
    drawn: LectureFlags,
    /// Print PSNR, SSIM, FLIP, brightness and other errors as well
    #[arg(long)]
    all_columns: bool,
    /// Print all as JSON
    #[arg(long, conflicts_with = "all_columns")]
    json: bool,
    #[command(flatten)]
    scene: SceneFlags,
}

impl Compare {
    /// Compares, times, and prints the table.
    pub fn run(&self, talk: &Talk) -> Result<Outcome, Failure> {
        let how = How {
            renderers: &[self.drawn.renderer()?],
            threads: &self.drawn.threads,
        };
        let mut comparisons = self
            .timing
            .compare(&[&self.input], &self.scene, how, *talk)?;
        if self.json || self.all_columns {
            comparisons.iter_mut().for_each(Comparison::perceive);
        }
        if self.json {
            let document = Document::new(&comparisons, &Machine::this(), &command_line());
            to_stdout(document.to_text().as_bytes())?;
        } else {
            let kind = match self.all_columns {
                true => TableKind::Compare,
                false => TableKind::Short,
            };
            for comparison in &comparisons {
                to_stdout(table(comparison, kind).as_bytes())?;
            }
        }
        Ok(Outcome::Done)
    }
}
