//! `fastphong report`: every method on every scene, as one page.

use super::engines::LectureFlags;
use super::figure::{drawn, page_folder};
use super::measured::{TimingFlags, command_line, named_or_shipped, warn_of_debug_build};
use super::progress::Progress;
use super::scene_flags::SceneFlags;
use super::studies::{Chosen, studies};
use super::talk::{Talk, to_stdout};
use super::{Failure, Outcome};
use fastphong::compare::comparison::{Input, compare, triangulation};
use fastphong::compare::timing::Machine;
use fastphong::lectures::{FIGURES, Figure};
use fastphong::picture::image_file::write_file;
use fastphong::report::{Caption, Detail, Report as Page, Section, utc_date};
use fastphong::scene::file::SceneFile;
use fastphong::scene::file::resolve::Resolved;
use fastphong::scene::input;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Compare methods on scenes, and show pictures, errors and times on one page
#[derive(clap::Args, Debug)]
pub struct Report {
    /// Scene files, mesh files, builtin:NAME?key=value, or names of shipped scenes [default: all shipped scenes]
    #[arg(value_name = "INPUT")]
    inputs: Vec<String>,
    #[command(flatten)]
    timing: TimingFlags,
    #[command(flatten)]
    drawn: LectureFlags,
    /// Where the page goes; its folder is made if there is none
    #[arg(short, long, value_name = "FILE", default_value = "report/index.html")]
    output: PathBuf,
    /// Figures of the lectures between commas, `all` or `none` [default: all with the shipped scenes, none with INPUT]
    #[arg(long, value_name = "NAMES", value_parser = figures)]
    figures: Option<Figures>,
    /// Studies between commas, `speedups` (what fast Phong gained and what is left of it) and `scaling` (how cost grows with
    /// triangles and pixels), `all` or `none` [default: all with the shipped scenes, none with INPUT]
    #[arg(long, value_name = "NAMES", value_parser = studies)]
    studies: Option<Chosen>,
    /// Difference maps of every pixel instead of squares of 4 x 4, and pictures that look like others too: a page of twice the size
    #[arg(long)]
    full: bool,
    /// Write README.md and its pictures beside the page as well
    #[arg(long)]
    markdown: bool,
    #[command(flatten)]
    scene: SceneFlags,
}

/// The figures of the lectures to show.
#[derive(Clone, Debug)]
struct Figures(Vec<&'static Figure>);

/// Figures between commas, each once, `all` or `none`.
fn figures(text: &str) -> Result<Figures, String> {
    match text {
        "all" => return Ok(Figures(FIGURES.to_vec())),
        "none" => return Ok(Figures(Vec::new())),
        _ => {}
    }
    let mut figures: Vec<&'static Figure> = Vec::new();
    for name in text.split(',') {
        let figure = Figure::find(name.trim())?;
        if figures.iter().all(|other| other.name != figure.name) {
            figures.push(figure);
        }
    }
    Ok(Figures(figures))
}

/// The folder of the small pictures, beside the text that shows them.
const IMAGES: &str = "images";

impl Report {
    /// Compares, times, and writes the page.
    pub fn run(&self, talk: &Talk) -> Result<Outcome, Failure> {
        let talk = *talk;
        self.drawn.install(|| self.make(talk))?
    }

    fn make(&self, talk: Talk) -> Result<Outcome, Failure> {
        let names = named_or_shipped(&self.inputs);
        // What can fail at once does so before the first minute is spent.
        let files = names
            .iter()
            .map(|name| self.scene.load(name))
            .collect::<Result<Vec<_>, Failure>>()?;
        let folder = page_folder(&self.output)?;
        let figures = self.figures();
        let machine = Machine::this();
        warn_of_debug_build(talk);
        let progress = Progress::silent_between_moves(talk);
        let studies = self.studies();
        // Figures take about as long as two scenes.
        let of_figures = if figures.is_empty() { 0.0 } else { 2.0 };
        let scenes = files.len() as f32 + of_figures + studies.scenes();
        let lecture = drawn(&figures, &|part, what| {
            progress.at(part * of_figures / scenes, what)
        })?;
        let told = |part: f32, what: &str| {
            progress.at((of_figures + part * studies.scenes()) / scenes, what)
        };
        let studies = studies.make(&self.timing, &told)?;
        let mut sections = Vec::with_capacity(files.len());
        for (number, (name, file)) in names.iter().zip(&files).enumerate() {
            let told = |part: f32, what: &str| {
                let done = scenes - files.len() as f32 + number as f32 + part;
                progress.at(done / scenes, &format!("{name}: {what}"));
            };
            told(0.0, "loading");
            let warn = |resolved: &Resolved| progress.aside(|| self.scene.warn(resolved, talk));
            sections.push(self.section(name, file, &warn, &told)?);
        }
        progress.at(1.0, "writing");
        let since_1970 = SystemTime::now()
            .duration_since(SystemTime::UNIX_EPOCH)
            .ok();
        let date = since_1970.map(|t| utc_date(t.as_secs()));
        let page = Page {
            sections,
            lecture,
            studies,
            machine,
            command_line: command_line(),
            date,
        };
        let written = self.write(&page, &folder)?;
        drop(progress);
        to_stdout(written.as_bytes())?;
        Ok(Outcome::Done)
    }

    /// The figures that were asked for.
    fn figures(&self) -> Vec<&'static Figure> {
        match &self.figures {
            Some(figures) => figures.0.clone(),
            None if self.inputs.is_empty() => FIGURES.to_vec(),
            None => Vec::new(),
        }
    }

    /// The studies that were asked for.
    fn studies(&self) -> Chosen {
        let usual = if self.inputs.is_empty() {
            Chosen::ALL
        } else {
            Chosen::default()
        };
        self.studies.unwrap_or(usual)
    }

    fn section(
        &self,
        name: &str,
        file: &SceneFile,
        warn: &dyn Fn(&Resolved),
        told: &dyn Fn(f32, &str),
    ) -> Result<Section, Failure> {
        let resolved = input::resolve(file)?;
        warn(&resolved);
        let frame = resolved.scene.frame()?;
        drop(resolved);
        let input = Input {
            name: name.to_owned(),
            frame: &frame,
        };
        // Comparing is most of the work; pictures are encoded in the rest.
        let options = self.timing.options(self.drawn.renderer()?);
        let comparison = compare(
            &input,
            &self.timing.methods.0,
            &options,
            &mut |part, what| told(0.9 * part, what),
        );
        told(0.9, "pictures");
        let triangles = triangulation(&frame, &comparison.reference);
        let caption = Caption {
            title: file.title().unwrap_or(name).to_owned(),
            description: file.description().unwrap_or_default().to_owned(),
        };
        let detail = if self.full {
            Detail::Full
        } else {
            Detail::Blocks
        };
        Section::new(caption, &comparison, triangles.as_ref(), detail)
            .map_err(|error| format!("{name}: {error}").into())
    }

    /// Writes the page, and what goes beside it; the paths, a line each.
    fn write(&self, page: &Page, folder: &Path) -> Result<String, Failure> {
        write_file(&self.output, page.html().as_bytes())?;
        let mut written = format!("{}\n", self.output.display());
        if self.markdown {
            let markdown = page.markdown(IMAGES);
            let images = folder.join(IMAGES);
            std::fs::create_dir_all(&images)
                .map_err(|error| format!("{}: cannot be made: {error}", images.display()))?;
            for image in &markdown.images {
                write_file(&images.join(&image.name), &image.png)?;
            }
            let readme = folder.join("README.md");
            write_file(&readme, markdown.text.as_bytes())?;
            written += &format!("{}\n", readme.display());
        }
        Ok(written)
    }
}
