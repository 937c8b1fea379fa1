//! The program as a shell runs it: its commands, files and words, and what the crate is made of.
#![cfg(feature = "app")]

mod cli_text;
mod cluster;
mod command_line;
mod dependencies;
mod figures;
mod fuzz;
mod house;
mod json_keys;
mod library;
mod memory_and_files;
mod no_threads;
mod report_page;
mod running;
mod scenario_files;
mod untrusted_text;

#[path = "../support/dice.rs"]
mod dice;
#[expect(dead_code, reason = "ensembles and maps are made up for the app only")]
#[path = "../support/made_up.rs"]
mod made_up;
#[path = "../support/program.rs"]
mod program;
#[path = "../support/renew.rs"]
mod renew;
#[path = "../support/skip.rs"]
mod skip;
