//! `fastphong figure`: figures of the lectures, made anew, as one page.

use super::measured::command_line;
use super::progress::Progress;
use super::talk::{Talk, to_stdout};
use super::{Failure, Outcome};
use fastphong::compare::timing::Machine;
use fastphong::lectures::{FIGURES, Figure, FigureContent};
use fastphong::picture::image_file::write_file;
use fastphong::report::{Document, Report};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Draw figures of the lectures anew, with what was measured beside them, as one page
#[derive(clap::Args, Debug)]
pub struct DrawFigures {
    /// Figures, as `fastphong list figures` names them
    #[arg(value_name = "NAME", required_unless_present = "all", value_parser = named)]
    names: Vec<&'static Figure>,
    /// All figures
    #[arg(long, conflicts_with = "names")]
    all: bool,
    /// Where the page goes; its folder is made if there is none [default: report/figures/NAME.html, or index.html there
    /// for several]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write the pictures as PNG files into this folder as well
    #[arg(long, value_name = "FOLDER")]
    pictures: Option<PathBuf>,
}

fn named(name: &str) -> Result<&'static Figure, String> {
    Figure::find(name)
}

impl DrawFigures {
    /// Draws, measures, and writes the page.
    pub fn run(&self, talk: &Talk) -> Result<Outcome, Failure> {
        let mut figures = if self.all {
            FIGURES.to_vec()
        } else {
            Vec::new()
        };
        for figure in &self.names {
            if figures.iter().all(|other| other.name != figure.name) {
                figures.push(figure);
            }
        }
        let page = match (&self.output, &figures[..]) {
            (Some(file), _) => file.clone(),
            (None, [one]) => Path::new("report/figures")
                .join(one.name)
                .with_extension("html"),
            (None, _) => Path::new("report/figures/index.html").to_owned(),
        };
        page_folder(&page)?;
        if let Some(folder) = &self.pictures {
            make_folder(folder)?;
        }
        let progress = Progress::watched(*talk);
        let drawn = drawn(&figures, &|part, what| progress.at(part, what))?;
        drop(progress);
        let mut report = Report::new(Document::new(Machine::this(), command_line()));
        add(&mut report, drawn)?;
        write_file(&page, report.html().as_bytes())?;
        let mut written = format!("{}\n", page.display());
        if let Some(folder) = &self.pictures {
            for (name, png) in report.figure_files() {
                let path = folder.join(name);
                write_file(&path, png)?;
                written += &format!("{}\n", path.display());
            }
        }
        to_stdout(written.as_bytes())?;
        Ok(Outcome::Done)
    }
}

/// A figure that was made.
pub type Made = (&'static Figure, FigureContent);

/// Makes `figures` on all threads of the current pool; `told` hears which part is done and what was made.
pub fn drawn(
    figures: &[&'static Figure],
    told: &(dyn Fn(f32, &str) + Sync),
) -> Result<Vec<Made>, Failure> {
    let done = AtomicUsize::new(0);
    let make = |figure: &&'static Figure| {
        let content = figure
            .make()
            .map_err(|error| refused(figure, &error.to_string()))?;
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        told(
            done as f32 / figures.len() as f32,
            &format!("figure {}", figure.name),
        );
        Ok((*figure, content))
    };
    figures.par_iter().map(make).collect()
}

/// Adds figures to a report.
pub fn add(report: &mut Report, figures: Vec<Made>) -> Result<(), Failure> {
    for (figure, content) in figures {
        report
            .add_figure(figure, content)
            .map_err(|error| refused(figure, &error.to_string()))?;
    }
    Ok(())
}

fn refused(figure: &Figure, reason: &str) -> Failure {
    format!("figure {}: {reason}", figure.name).into()
}

/// The folder of a page, made if need be.
pub fn page_folder(page: &Path) -> Result<PathBuf, Failure> {
    let folder = page.parent().unwrap_or(Path::new("")).to_owned();
    let refused =
        |reason: &str| Failure::from(format!("{}: cannot be written: {reason}", page.display()));
    if page.file_name().is_none() || page.is_dir() {
        return Err(refused(
            "it is a folder: expected a file, such as report/index.html",
        ));
    }
    if !folder.as_os_str().is_empty() {
        std::fs::create_dir_all(&folder).map_err(|error| refused(&error.to_string()))?;
    }
    Ok(folder)
}

/// A folder, made if need be.
fn make_folder(folder: &Path) -> Result<(), Failure> {
    let refused = |error: std::io::Error| format!("{}: cannot be made: {error}", folder.display());
    std::fs::create_dir_all(folder).map_err(refused)?;
    Ok(())
}
