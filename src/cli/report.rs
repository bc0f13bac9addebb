//! `fastphong report`: every method on every scene, as one page.

use super::progress::Progress;
use super::talk::{Talk, to_stdout};
use super::{Failure, Outcome};
use fastphong::bench::{Limits, Machine};
use fastphong::comparison::{Input, Options, compare, triangulation};
use fastphong::image_file::write_file;
use fastphong::input::{self, SCENES};
use fastphong::report::{Caption, Report as Page, Section, utc_date};
use fastphong::scene::file::SceneFile;
use fastphong::shader::{METHODS, Variant};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Compare methods on scenes, and show pictures, errors and times on one page
#[derive(clap::Args, Debug)]
pub struct Report {
    /// Scene files, mesh files, builtin:NAME?key=value, or names of shipped scenes [default: all shipped scenes]
    #[arg(value_name = "INPUT")]
    inputs: Vec<String>,
    /// Methods between commas, with parameters as in `fast-phong:steps=1`, or `all`; naive-phong is always among them
    #[arg(short, long, value_name = "METHODS", default_value = "all", value_parser = methods)]
    methods: Methods,
    /// Where the page goes; its folder is made if there is none
    #[arg(short, long, value_name = "FILE", default_value = "report/index.html")]
    output: PathBuf,
    /// Write README.md and its pictures beside the page as well
    #[arg(long)]
    markdown: bool,
    /// Seconds of timing a scene, at least five rounds of all methods
    #[arg(long, value_name = "SECONDS", default_value = "2", value_parser = seconds, allow_hyphen_values = true)]
    time_budget: Duration,
}

/// The methods to compare.
#[derive(Clone, Debug)]
struct Methods(Vec<Variant>);

fn methods(text: &str) -> Result<Methods, String> {
    if text == "all" {
        return Ok(Methods(METHODS.iter().map(|entry| entry.variant()).collect()));
    }
    let mut variants: Vec<Variant> = Vec::new();
    for name in text.split(',') {
        let variant = Variant::parse(name.trim()).map_err(|error| error.to_string())?;
        if variants.iter().all(|other| other.to_string() != variant.to_string()) {
            variants.push(variant);
        }
    }
    Ok(Methods(variants))
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    seconds.ok_or_else(|| "expected seconds: a number, 0 or more".to_owned())
}

/// The folder of the small pictures, beside the text that shows them.
const IMAGES: &str = "images";

impl Report {
    /// Compares, times, and writes the page.
    pub fn run(&self, talk: &Talk) -> Result<Outcome, Failure> {
        let talk = *talk;
        let names: Vec<&str> = match &self.inputs[..] {
            [] => SCENES.iter().map(|scene| scene.name).collect(),
            inputs => inputs.iter().map(String::as_str).collect(),
        };
        // What can fail at once does so before the first minute is spent.
        let files = names.iter().map(|name| Ok((*name, input::load(name)?))).collect::<Result<Vec<_>, Failure>>()?;
        let folder = self.folder()?;
        let machine = Machine::this();
        if machine.profile != "release" {
            talk.warning("built without optimisation: the times say nothing (cargo build --release)");
        }
        let progress = Progress::silent_between_moves(talk);
        let mut sections = Vec::with_capacity(files.len());
        for (number, (name, file)) in files.iter().enumerate() {
            let told = |part: f32, what: &str| {
                progress.at((number as f32 + part) / files.len() as f32, &format!("{name}: {what}"));
            };
            told(0.0, "loading");
            sections.push(self.section(name, file, &|warning| progress.aside(|| talk.warning(warning)), &told)?);
        }
        progress.at(1.0, "writing");
        let since_1970 = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).ok();
        let page =
            Page { sections, machine, command_line: command_line(), date: since_1970.map(|t| utc_date(t.as_secs())) };
        let written = self.write(&page, &folder)?;
        drop(progress);
        to_stdout(written.as_bytes())?;
        Ok(Outcome::Done)
    }

    /// The folder of the page, made if need be.
    fn folder(&self) -> Result<PathBuf, Failure> {
        let folder = self.output.parent().unwrap_or(Path::new("")).to_owned();
        let refused = |reason: &str| Failure::from(format!("{}: cannot be written: {reason}", self.output.display()));
        if self.output.file_name().is_none() || self.output.is_dir() {
            return Err(refused("it is a folder: expected a file, such as report/index.html"));
        }
        if !folder.as_os_str().is_empty() {
            std::fs::create_dir_all(&folder).map_err(|error| refused(&error.to_string()))?;
        }
        Ok(folder)
    }

    fn section(
        &self,
        name: &str,
        file: &SceneFile,
        warn: &dyn Fn(&str),
        told: &dyn Fn(f32, &str),
    ) -> Result<Section, Failure> {
        let resolved = input::resolve(file)?;
        resolved.warnings.iter().for_each(|warning| warn(&format!("{name}: {warning}")));
        let frame = resolved.scene.frame()?;
        drop(resolved);
        let limits = Limits { time_budget: self.time_budget, warm_up_rounds: 1, ..Limits::default() };
        let options = Options { timing: Some(limits) };
        let input = Input { name: name.to_owned(), frame: &frame };
        // Comparing is most of the work; pictures are encoded in the rest.
        let comparison = compare(&input, &self.methods.0, &options, &mut |part, what| told(0.9 * part, what));
        told(0.9, "pictures");
        let triangles = triangulation(&frame, &comparison.reference);
        let text = |text: &Option<fastphong::scene::value::Located<String>>| text.as_ref().map(|t| t.value.clone());
        let caption = Caption {
            title: text(&file.title).unwrap_or_else(|| name.to_owned()),
            description: text(&file.description).unwrap_or_default(),
        };
        Section::new(caption, &comparison, triangles.as_ref()).map_err(|error| format!("{name}: {error}").into())
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

/// What was typed, with the program by its name and not by its place.
fn command_line() -> Vec<String> {
    let typed = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    std::iter::once("fastphong".to_owned()).chain(typed).collect()
}
