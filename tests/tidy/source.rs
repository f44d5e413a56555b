//! Our own code, parsed: which module a file is, what it names, what it calls. Code under `#[cfg(test)]` is left out:
//! the rules are about the product.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// One file of ours.
pub(crate) struct File {
    /// Its path from the project's folder, `/` between the parts.
    pub(crate) path: String,
    /// Its text.
    pub(crate) text: String,
    syntax: syn::File,
    /// Declared under `#[cfg(test)]`.
    only_tests: bool,
}

/// A path in the code (`use` trees flattened), and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Name {
    /// What it begins with.
    pub(crate) root: Root,
    /// The parts after the root.
    pub(crate) parts: Vec<String>,
    /// Line, from 1.
    pub(crate) line: usize,
}

/// What a path begins with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Root {
    /// Our crate.
    Ours,
    /// Another crate, or a name in scope.
    Other,
}

/// A call of a method or macro, or a function, with a name and a size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Named {
    /// Its name; a macro's ends with `!`.
    pub(crate) name: String,
    /// Line, from 1.
    pub(crate) line: usize,
    /// Lines from its first to its last.
    pub(crate) lines: usize,
    /// Arguments of a function, `self` not counted.
    pub(crate) arguments: usize,
}

/// What a file says.
#[derive(Debug, Default)]
pub(crate) struct Contents {
    /// Every path.
    pub(crate) names: Vec<Name>,
    /// Every call of a method or macro.
    pub(crate) calls: Vec<Named>,
    /// Every function.
    pub(crate) functions: Vec<Named>,
    /// Every attribute's first word.
    pub(crate) attributes: Vec<Named>,
}

/// The project's folder.
pub(crate) fn home() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every Rust file in `folder` of the project, sorted.
pub(crate) fn files(folder: &str) -> Vec<File> {
    let mut paths = Vec::new();
    collect(&home().join(folder), &mut paths);
    paths.sort();
    let mut files: Vec<File> = paths.iter().map(|path| File::read(path)).collect();
    let tests: Vec<Vec<String>> = files.iter().flat_map(File::test_modules).collect();
    for file in &mut files {
        let module = file.module();
        file.only_tests = tests.iter().any(|test| module.starts_with(test));
    }
    files
}

fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder of the project") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => collect(&path, found),
            false if path.extension().is_some_and(|ending| ending == "rs") => found.push(path),
            false => {}
        }
    }
}

impl File {
    fn read(path: &Path) -> File {
        let text = std::fs::read_to_string(path).expect("a file of the project");
        let relative = path.strip_prefix(home()).expect("inside the project");
        File::new(&relative.to_string_lossy().replace('\\', "/"), &text)
    }

    /// A file of that path and text, which may be made up.
    pub(crate) fn new(path: &str, text: &str) -> File {
        let syntax = syn::parse_file(text).unwrap_or_else(|error| panic!("{path}: {error}"));
        File { path: path.into(), text: text.into(), syntax, only_tests: false }
    }

    /// Its module path in the crate: `src/physics/paper/mod.rs` is physics, paper; `src/lib.rs` nothing.
    pub(crate) fn module(&self) -> Vec<String> {
        let inside = self.path.trim_start_matches("src/").trim_end_matches(".rs").trim_end_matches("/mod");
        inside.split('/').filter(|part| *part != "lib" && *part != "mod").map(String::from).collect()
    }

    /// What it says, outside its tests.
    pub(crate) fn contents(&self) -> Contents {
        let mut reader = Reader { scope: self.module(), children: self.children(), contents: Contents::default() };
        reader.visit_file(&self.syntax);
        match self.only_tests {
            true => Contents { functions: reader.contents.functions, ..Contents::default() },
            false => reader.contents,
        }
    }

    /// The modules in other files that it declares for tests only.
    fn test_modules(&self) -> Vec<Vec<String>> {
        let declared = self.syntax.items.iter().filter_map(|item| match item {
            syn::Item::Mod(module) if module.content.is_none() && only_in_tests(&module.attrs) => {
                Some([self.module(), vec![module.ident.to_string()]].concat())
            }
            _ => None,
        });
        declared.collect()
    }

    /// The modules declared in it: `contact::Contact` in `physics/mod.rs` is ours.
    pub(crate) fn children(&self) -> BTreeSet<String> {
        let declared = self.syntax.items.iter().filter_map(|item| match item {
            syn::Item::Mod(module) => Some(module.ident.to_string()),
            _ => None,
        });
        declared.collect()
    }
}

struct Reader {
    scope: Vec<String>,
    children: BTreeSet<String>,
    contents: Contents,
}

impl Reader {
    /// Resolves `crate`, `self`, `super` and our own child modules.
    fn name(&mut self, parts: &[String], line: usize) {
        let (mut base, mut rest) = (self.scope.clone(), parts);
        let mut root = Root::Ours;
        match parts.first().map(String::as_str) {
            Some("crate" | "carom") => (base, rest) = (Vec::new(), &parts[1..]),
            Some("self") => rest = &parts[1..],
            Some("super") => {
                while rest.first().is_some_and(|part| part == "super") {
                    base.pop();
                    rest = &rest[1..];
                }
            }
            Some(first) if self.children.contains(first) => {}
            _ => (root, base) = (Root::Other, Vec::new()),
        }
        base.extend_from_slice(rest);
        self.contents.names.push(Name { root, parts: base, line });
    }

    fn use_tree(&mut self, tree: &syn::UseTree, before: &[String]) {
        let with = |ident: &syn::Ident| [before, &[ident.to_string()]].concat();
        match tree {
            syn::UseTree::Path(path) => self.use_tree(&path.tree, &with(&path.ident)),
            syn::UseTree::Name(name) => self.name(&with(&name.ident), name.ident.span().start().line),
            syn::UseTree::Rename(rename) => self.name(&with(&rename.ident), rename.ident.span().start().line),
            syn::UseTree::Glob(glob) => {
                let all = [before, &["*".to_string()]].concat();
                self.name(&all, glob.star_token.span().start().line);
            }
            syn::UseTree::Group(group) => group.items.iter().for_each(|tree| self.use_tree(tree, before)),
        }
    }

    /// Paths in a macro's arguments, which are tokens only; nor are calls there seen otherwise.
    fn tokens(&mut self, tokens: TokenStream) {
        let mut parts: Vec<String> = Vec::new();
        let (mut between, mut line) = (String::new(), 0);
        for token in tokens {
            match token {
                TokenTree::Ident(ident) => {
                    if between != "::" {
                        self.flush(&mut parts, line);
                    }
                    line = ident.span().start().line;
                    if between == "." {
                        self.call(ident.to_string(), line);
                    }
                    parts.push(ident.to_string());
                    between.clear();
                }
                TokenTree::Punct(punct) => between.push(punct.as_char()),
                TokenTree::Group(group) => {
                    self.flush(&mut parts, line);
                    self.tokens(group.stream());
                    between.clear();
                }
                TokenTree::Literal(_) => between.clear(),
            }
        }
        self.flush(&mut parts, line);
    }

    fn flush(&mut self, parts: &mut Vec<String>, line: usize) {
        if parts.len() > 1 {
            self.name(parts, line);
        }
        parts.clear();
    }

    fn call(&mut self, name: String, line: usize) {
        self.contents.calls.push(Named { name, line, lines: 1, arguments: 0 });
    }

    fn function(&mut self, signature: &syn::Signature, body: &syn::Block) {
        let (line, end) = (signature.span().start().line, body.span().end().line);
        let arguments = signature.inputs.iter().filter(|input| matches!(input, syn::FnArg::Typed(_))).count();
        let name = signature.ident.to_string();
        self.contents.functions.push(Named { name, line, lines: end - line + 1, arguments });
    }
}

fn only_in_tests(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        syn::Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        _ => false,
    })
}

impl<'ast> Visit<'ast> for Reader {
    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        if only_in_tests(&module.attrs) {
            return;
        }
        self.scope.push(module.ident.to_string());
        visit::visit_item_mod(self, module);
        self.scope.pop();
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        if !only_in_tests(&item.attrs) {
            self.use_tree(&item.tree, &[]);
        }
    }

    fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
        if !only_in_tests(&function.attrs) {
            self.function(&function.sig, &function.block);
            visit::visit_item_fn(self, function);
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if !only_in_tests(&item.attrs) {
            visit::visit_item_impl(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
        if !only_in_tests(&function.attrs) {
            self.function(&function.sig, &function.block);
            visit::visit_impl_item_fn(self, function);
        }
    }

    /// `pub(in crate::physics)` says from where a name may be used, and uses nothing of that place.
    fn visit_vis_restricted(&mut self, _: &'ast syn::VisRestricted) {}

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let parts: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        if parts.len() > 1 {
            self.name(&parts, path.span().start().line);
        }
        visit::visit_path(self, path);
    }

    fn visit_attribute(&mut self, attribute: &'ast syn::Attribute) {
        let line = attribute.span().start().line;
        let name = attribute.path().segments.first().map(|segment| segment.ident.to_string()).unwrap_or_default();
        self.contents.attributes.push(Named { name, line, lines: 1, arguments: 0 });
        if let syn::Meta::List(list) = &attribute.meta {
            self.tokens(list.tokens.clone());
        }
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        self.call(call.method.to_string(), call.method.span().start().line);
        visit::visit_expr_method_call(self, call);
    }

    fn visit_macro(&mut self, called: &'ast syn::Macro) {
        let name = called.path.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default();
        self.call(format!("{name}!"), called.path.span().start().line);
        self.tokens(called.tokens.clone());
    }
}
