//! `fastphong diagnose`: why a picture of a scene is wrong.

mod json;
mod strip;
mod text;

use super::output::{self, Output, print_beside};
use super::progress::Progress;
use super::scene_flags::{SceneFlags, frame_of, note_scene};
use super::{CliError, Log, Outcome, files, input_name};
use crate::diagnose::{Asked, DiagnoseError, Question, answer, diagnose, find_window};
use fastphong::frame::Frame;
use fastphong::glam::DVec3;
use fastphong::picture::image_file::FilePicture;
use fastphong::raster::{Plan, Renderer};
use fastphong::scene::Scene;
use fastphong::scene::file::SceneFile;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::value::{Data, SceneTable};
use fastphong::scene::open::{Look, Opened};
use fastphong::shading::Variant;
use std::path::PathBuf;
use std::time::Instant;

/// Find the mistakes that make your picture of a scene wrong
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub struct DiagnoseArgs {
    /// Your picture: PNG, PBM, PGM, PPM, PAM, PFM, BMP or Targa. The scene is drawn at its size
    picture: PathBuf,
    /// Scene that the picture shows: scene file, mesh file, builtin:NAME?key=value, name of a
    /// shipped scene, or `-`
    #[arg(value_parser = input_name::parser())]
    input: String,
    /// Method that the picture should show: `flat`, `gouraud`, `phong`, or one of
    /// `fastphong list methods --all` [default: phong]
    #[arg(long = "as", value_name = "METHOD", value_parser = method)]
    method: Option<Variant>,
    /// Write pictures side by side: yours, the reference, the reference with your mistakes, and
    /// what each correction changes; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print everything as JSON, including the error that each mistake would leave
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    scene: SceneFlags,
}

const AFTER: &str = "Exit codes: 0 the picture is right, 1 it is not, 2 wrong usage or input.\n\
    `fastphong list mistakes` lists the mistakes that it looks for.";

/// A scene, its own size, and the pixel of the picture that shows its first pixel, if the picture
/// has another size.
type SizedScene = (Opened, [u32; 2], Option<[isize; 2]>);

impl DiagnoseArgs {
    /// Reads the picture, looks for mistakes and prints what it found.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let started = Instant::now();
        let output = self
            .output
            .as_deref()
            .map(|path| Output::of_picture(path, None))
            .transpose()?;
        let outputs: Vec<&Output> = output.iter().collect();
        let file = self.scene.read(&self.input)?;
        files::will_read(&self.picture, "the picture");
        output::check(&outputs)?;
        let picture = files::picture(&self.picture, "the picture")?;
        for note in &picture.notes {
            log.warning(&format!("{}: {note}", self.picture.display()));
        }
        let progress = Progress::watched(log);
        progress.at(0.0, "loading the scene");
        let (mut opened, own_size, at) = self.sized(file, &picture)?;
        opened.scene.samples = 1;
        progress.aside(|| note_scene(&opened, log));
        let frame = progress.aside(|| frame_of(&opened, log))?;
        self.check_method(&frame)?;
        drop(frame);
        let scene = &opened.scene;
        let question = Question {
            scene,
            method: self.method.as_ref(),
            picture: &picture,
            at,
            light_lengths: &light_lengths(&opened.file),
        };
        let found = diagnose(&question, &mut |share| {
            progress.at(share, "drawing mistakes");
        });
        let found = found.map_err(|error| self.error(&error, picture.size()))?;
        let text = if self.json {
            format!("{:#}\n", json::json(self, scene, &found, started.elapsed()))
        } else {
            let own = [own_size, [scene.width, scene.height]];
            let asked = Asked {
                picture: &self.picture.display().to_string(),
                scene: &self.input,
                method: self.method.as_ref().map(ToString::to_string),
                sizes: own,
            };
            text::text(&answer(&asked, &found))
        };
        if let Some(output) = &output {
            progress.at(1.0, "drawing the pictures");
            let strip = strip::strip(&question, &found)
                .map_err(|error| self.error(&error, picture.size()))?;
            let strip = FilePicture::stored(strip).encoded(scene.encoding);
            output.write_encoded(&strip)?;
        }
        drop(progress);
        print_beside(&outputs, &text)?;
        Ok(if found.is_correct() {
            Outcome::Done
        } else {
            Outcome::Differs
        })
    }

    /// Returns the scene, the scene's own size, and where the picture shows it. A picture of the
    /// scene's own size with columns and rows exchanged leaves the scene as it was, and so does a
    /// picture of another size in which the scene is found. Otherwise the scene is resized to the
    /// picture. Meshes are read again only then, because a fitted camera depends on the size.
    fn sized(&self, mut file: SceneFile, picture: &FilePicture) -> Result<SizedScene, CliError> {
        let [width, height] = picture.size();
        let most = Scene::MAX_SIDE as usize;
        if width.max(height) > most {
            let found = format!("{}: has {width}x{height} pixels", self.picture.display());
            return Err(format!("{found}: expected at most {most} a side").into());
        }
        let opened = self.scene.open_file(file.clone(), Look::Compared)?;
        let own_size = [opened.scene.width, opened.scene.height];
        let [own_width, own_height] = own_size;
        let own = [own_width, own_height].map(|side| side as usize);
        if own == [width, height] || own == [height, width] {
            return Ok((opened, own_size, None));
        }
        if let Some(at) = find_window(&opened.scene, picture) {
            return Ok((opened, own_size, Some(at)));
        }
        if self.scene.over().sets("image.width") {
            let found = format!("{}: has {width}x{height} pixels", self.picture.display());
            let expected = format!("expected {own_width}x{own_height}, as --resolution says");
            return Err(format!("{found}: {expected}").into());
        }
        let mut size = SceneTable::default();
        let image = size.table_mut("image");
        image.set("width", Data::Whole(width as i64), Origin::Program);
        image.set("height", Data::Whole(height as i64), Origin::Program);
        file.overlay(size);
        let opened = self.scene.open_file(file, Look::Compared)?;
        Ok((opened, own_size, None))
    }

    /// Checks that the method asked for can draw the scene.
    fn check_method(&self, frame: &Frame) -> Result<(), CliError> {
        let Some(method) = &self.method else {
            return Ok(());
        };
        match method.plan(frame, Renderer::LECTURE) {
            Plan::Refused(reason) => Err(format!("--as {method}: {reason}").into()),
            _ => Ok(()),
        }
    }

    fn error(&self, error: &DiagnoseError, size: [usize; 2]) -> CliError {
        match error {
            DiagnoseError::Frame(error) => CliError::from(error.to_string()),
            DiagnoseError::NothingToCompare => {
                let [width, height] = size.map(|side| side.to_string());
                let problem = format!(
                    "{}: too little of it is visible at {width}x{height} pixels",
                    self.input
                );
                CliError::from(format!("{problem}: expected at least 30 covered pixels"))
            }
        }
    }
}

/// Reads the method of an exercise. `phong` stands for naive Phong.
fn method(text: &str) -> Result<Variant, String> {
    let name = if text == "phong" { "naive-phong" } else { text };
    Variant::parse(name).map_err(|error| error.to_string())
}

/// Returns the length of each light's direction as the scene file states it; 1 for a light at a
/// position.
fn light_lengths(file: &SceneFile) -> Vec<f64> {
    let lights = file.table().tables("light").iter();
    let length = |light: &SceneTable| light.triple("direction").map_or(1.0, DVec3::length);
    lights.map(length).collect()
}
