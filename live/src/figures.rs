//! Figures of the lectures, made anew for values of their handles.

use crate::studio::Studio;
use fastphong::lectures::{FigureBlock, LIVE, trace_of_stop};

impl Studio {
    pub fn figure(&mut self) -> Result<usize, String> {
        let text = String::from_utf8_lossy(&self.text).into_owned();
        let (name, values) = text.split_once('\n').unwrap_or((&text, ""));
        let live = LIVE.iter().find(|(known, _)| *known == name);
        let (_, live) = live.ok_or_else(|| format!("no live figure is called {name}"))?;
        let values = numbers(values)?;
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

    pub fn trace(&mut self) -> Result<usize, String> {
        let text = String::from_utf8_lossy(&self.text).into_owned();
        let (method, values) = text.split_once('\n').unwrap_or((&text, ""));
        let trace = trace_of_stop(method, &numbers(values)?).map_err(|error| error.to_string())?;
        let json = serde_json::to_string(&trace).map_err(|error| error.to_string())?;
        Ok(self.say(json))
    }

    pub fn panel(&mut self, number: usize) -> *const u32 {
        self.panel = self.panels.get(number).map_or([0; 3], |picture| {
            let address = picture.pixels().as_ptr().addr();
            [picture.width(), picture.height(), address].map(|n| n as u32)
        });
        self.panel.as_ptr()
    }
}

/// Reads numbers that stand apart.
fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let number = |word: &str| word.parse().map_err(|error| format!("{word}: {error}"));
    text.split_whitespace().map(number).collect()
}
