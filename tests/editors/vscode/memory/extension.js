// A file system that is no disk: memory:/workspace with the files that lie in `files` of this extension.
const { readdirSync, readFileSync } = require("node:fs");
const { join } = require("node:path");
const { EventEmitter, FileSystemError, FileType, workspace } = require("vscode");

exports.activate = (context) => {
  const source = join(context.extensionPath, "files");
  const files = new Map(readdirSync(source).map((name) => [`/workspace/${name}`, readFileSync(join(source, name))]));
  const file = (uri) => {
    const found = files.get(uri.path);
    if (found === undefined) throw FileSystemError.FileNotFound(uri);
    return found;
  };
  const isFolder = ({ path }) => path === "/" || path === "/workspace";
  const provider = {
    onDidChangeFile: new EventEmitter().event,
    watch: () => ({ dispose() {} }),
    stat: (uri) => {
      const [type, size] = isFolder(uri) ? [FileType.Directory, 0] : [FileType.File, file(uri).length];
      return { type, ctime: 0, mtime: 0, size };
    },
    readDirectory: () => [...files.keys()].map((path) => [path.slice("/workspace/".length), FileType.File]),
    readFile: file,
    writeFile: (uri, content) => void files.set(uri.path, content),
    createDirectory: (uri) => {
      throw FileSystemError.NoPermissions(uri);
    },
    delete: (uri) => void files.delete(uri.path),
    rename: (uri) => {
      throw FileSystemError.NoPermissions(uri);
    },
  };
  context.subscriptions.push(workspace.registerFileSystemProvider("memory", provider, { isCaseSensitive: true }));
};
