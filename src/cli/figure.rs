//! `fastphong figure`: figures of the lectures, made anew, as one page.

use super::measured::command_line;
use super::progress::Progress;
use super::talk::{Talk, to_stdout};
use super::{Failure, Outcome};
use fastphong::lectures::{FIGURES, Figure};
use fastphong::picture::image_file::write_file;
use fastphong::report::{LectureFigure, figures_page};
use std::path::{Path, PathBuf};

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
        write_file(&page, figures_page(&drawn, &command_line()).as_bytes())?;
        let mut written = format!("{}\n", page.display());
        if let Some(folder) = &self.pictures {
            for (name, png) in drawn.iter().flat_map(LectureFigure::files) {
                let path = folder.join(name);
                write_file(&path, png)?;
                written += &format!("{}\n", path.display());
            }
        }
        to_stdout(written.as_bytes())?;
        Ok(Outcome::Done)
    }
}

/// Makes `figures`; `told` hears which part is done and what comes next.
pub fn drawn(
    figures: &[&'static Figure],
    told: &dyn Fn(f32, &str),
) -> Result<Vec<LectureFigure>, Failure> {
    let mut drawn = Vec::with_capacity(figures.len());
    for (number, figure) in figures.iter().enumerate() {
        told(
            number as f32 / figures.len() as f32,
            &format!("figure {}", figure.name),
        );
        let refused = |reason: String| Failure::from(format!("figure {}: {reason}", figure.name));
        let content = figure.make().map_err(|error| refused(error.to_string()))?;
        drawn
            .push(LectureFigure::new(figure, content).map_err(|error| refused(error.to_string()))?);
    }
    Ok(drawn)
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
