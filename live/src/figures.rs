//! Makes figures of the lectures for new values of their handles.

use crate::studio::Studio;
use fastphong_cli::lectures::{FigureBlock, LIVE, trace_of_stop};

impl Studio {
    /// Makes the figure that the text names, writes its content into the text, and returns the
    /// text's length.
    pub fn figure(&mut self) -> Result<usize, String> {
        let text = String::from_utf8_lossy(&self.text).into_owned();
        let (name, values) = text.split_once('\n').unwrap_or((&text, ""));
        let live = LIVE.iter().find(|(known, _)| *known == name);
        let (_, live) = live.ok_or_else(|| format!("no live figure is called {name}"))?;
        let values = parse_values(values)?;
        let content = live.make(&values).map_err(|error| error.to_string())?;
        self.panels.clear();
        for block in &content.blocks {
            if let FigureBlock::Pictures { shown, .. } = block {
                self.panels
                    .extend(shown.iter().map(|panel| panel.picture.clone()));
            }
        }
        let json = serde_json::to_string(&content).map_err(|error| error.to_string())?;
        Ok(self.say(json))
    }

    /// Traces the method that the text names, writes the trace into the text, and returns the
    /// text's length.
    pub fn trace(&mut self) -> Result<usize, String> {
        let text = String::from_utf8_lossy(&self.text).into_owned();
        let (method, values) = text.split_once('\n').unwrap_or((&text, ""));
        let trace =
            trace_of_stop(method, &parse_values(values)?).map_err(|error| error.to_string())?;
        let json = serde_json::to_string(&trace).map_err(|error| error.to_string())?;
        Ok(self.say(json))
    }

    /// Returns the address of three values: the width, the height and the address of the figure's
    /// picture at `index`. All are 0 if there is no picture at this index.
    pub fn panel(&mut self, index: usize) -> *const u32 {
        self.panel = self.panels.get(index).map_or([0; 3], |picture| {
            let address = picture.pixels().as_ptr().addr();
            [picture.width(), picture.height(), address].map(|n| n as u32)
        });
        self.panel.as_ptr()
    }
}

/// Parses values that are separated by white space.
fn parse_values(text: &str) -> Result<Vec<f64>, String> {
    let value = |word: &str| word.parse().map_err(|error| format!("{word}: {error}"));
    text.split_whitespace().map(value).collect()
}
