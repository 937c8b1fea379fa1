//! The command that repeats a blow.

/// The whole command as a shell takes it.
pub fn line(subcommand: &str, arguments: &[String]) -> String {
    let words = ["contrecoup", subcommand].into_iter();
    shell_words::join(words.chain(arguments.iter().map(String::as_str)))
}
