"""A session of the language server with a client of another project.

pytest-lsp reads every message into the types of the protocol's own
specification and fails on one that does not fit. The capabilities are those
that editors have been recorded to announce.
"""

import asyncio
import os
import pathlib

import pytest
import pytest_lsp
from lsprotocol import types
from pytest_lsp import ClientServerConfig, LanguageClient, client_capabilities
from pytest_lsp.client import DEFAULT_CLIENT_FEATURES, default_converter, register_lsp_features

REPOSITORY = pathlib.Path(__file__).parents[3]
TANK = REPOSITORY / "fixtures" / "neutralization" / "neutralization.ladder"
SERVER = os.environ["GRADUS"]

# What the client is asked and does not answer by itself.
REFRESHES = [
    types.WORKSPACE_CODE_LENS_REFRESH,
    types.WORKSPACE_INLAY_HINT_REFRESH,
    types.WORKSPACE_SEMANTIC_TOKENS_REFRESH,
]


def attentive_client() -> LanguageClient:
    """A client that keeps every publication of findings in its order.

    Several arrive between two looks of a test; waiting for the next would miss some.
    """
    client = LanguageClient(converter_factory=default_converter)
    client.published = asyncio.Queue()

    def keep(params: types.PublishDiagnosticsParams):
        client.published.put_nowait(params)

    keeps = {types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS: keep}
    register_lsp_features(client, DEFAULT_CLIENT_FEATURES | keeps)
    return client


@pytest_lsp.fixture(
    params=["visual-studio-code", "neovim", "emacs"],
    config=ClientServerConfig(server_command=[SERVER, "lsp"], client_factory=attentive_client),
)
async def client(request, lsp_client: LanguageClient, tmp_path: pathlib.Path):
    lsp_client.folder = tmp_path
    lsp_client.watched = []

    @lsp_client.feature(types.CLIENT_REGISTER_CAPABILITY)
    def _(params: types.RegistrationParams):
        lsp_client.watched.extend(it.method for it in params.registrations)

    for refresh in REFRESHES:
        lsp_client.feature(refresh)(lambda _: None)
    lsp_client.server = await lsp_client.initialize_session(
        types.InitializeParams(
            capabilities=client_capabilities(request.param),
            workspace_folders=[types.WorkspaceFolder(tmp_path.as_uri(), "test")],
        )
    )
    yield
    await lsp_client.shutdown_session()


def opened(client: LanguageClient, name: str, language: str, text: str) -> str:
    """The address of a document that the client now has open."""
    uri = (client.folder / name).as_uri()
    item = types.TextDocumentItem(uri, language, 1, text)
    client.text_document_did_open(types.DidOpenTextDocumentParams(item))
    return uri


async def findings(client: LanguageClient, uri: str, version: int) -> list[types.Diagnostic]:
    """What the server finds in this version of a document."""
    if client.server.capabilities.diagnostic_provider:
        document = types.TextDocumentIdentifier(uri)
        params = types.DocumentDiagnosticParams(document)
        report = await client.text_document_diagnostic_async(params)
        return list(report.items)
    while True:
        told = await client.published.get()
        if told.uri == uri and told.version == version:
            return list(told.diagnostics)


@pytest.mark.asyncio
async def test_findings_follow_the_edits(client: LanguageClient):
    text = "input a\nrung: a -> b\nrung: a -> b\n"
    uri = opened(client, "twice.ladder", "gradus-ladder", text)
    found = await findings(client, uri, 1)
    assert [finding.code for finding in found] == ["G2002"]
    assert found[0].range == types.Range(types.Position(2, 11), types.Position(2, 12))
    document = types.VersionedTextDocumentIdentifier(2, uri)
    rung = types.Range(types.Position(2, 0), types.Position(3, 0))
    change = types.TextDocumentContentChangePartial(range=rung, text="")
    client.text_document_did_change(types.DidChangeTextDocumentParams(document, [change]))
    assert await findings(client, uri, 2) == []


@pytest.mark.asyncio
async def test_a_hover_shows_the_conditions_of_a_coil(client: LanguageClient):
    text = TANK.read_text(encoding="utf-8")
    uri = opened(client, "tank.ladder", "gradus-ladder", text)
    line, column = next(
        (number, line.index("-> v1") + 3)
        for number, line in enumerate(text.splitlines())
        if "-> v1" in line
    )
    place = types.HoverParams(types.TextDocumentIdentifier(uri), types.Position(line, column))
    hover = await client.text_document_hover_async(place)
    assert hover.contents.value.startswith(("**v1**", "v1"))
    assert "turns on" in hover.contents.value
    assert hover.range.start == types.Position(line, column)


@pytest.mark.asyncio
async def test_a_spec_is_checked_against_its_ladder(client: LanguageClient):
    ladder = opened(client, "tank.ladder", "gradus-ladder", "input a\nrung: a -> b\n")
    await findings(client, ladder, 1)
    spec = opened(client, "tank.grafcet", "grafcet", "Grafcet Tank\nStep Xv1 for v1\nMarking Xv1\n")
    assert "G3102" in [finding.code for finding in await findings(client, spec, 1)]


@pytest.mark.asyncio
async def test_files_are_watched_by_who_can(client: LanguageClient):
    uri = opened(client, "a.ladder", "gradus-ladder", "input a\nrung: a -> b\n")
    await findings(client, uri, 1)
    watches = client.capabilities.workspace.did_change_watched_files
    can = watches is not None and watches.dynamic_registration
    assert client.watched == (["workspace/didChangeWatchedFiles"] if can else [])


@pytest.mark.asyncio
async def test_all_files_are_told_of_to_who_asks(client: LanguageClient):
    provider = client.server.capabilities.diagnostic_provider
    if provider is None:
        return
    assert provider.workspace_diagnostics
    (client.folder / "twice.ladder").write_text("input a\nrung: a -> b\nrung: a -> b\n")
    (client.folder / "quiet.ladder").write_text("input a\nrung: a -> b\n")
    report = await client.workspace_diagnostic_async(types.WorkspaceDiagnosticParams([]))
    assert all(isinstance(it, types.WorkspaceFullDocumentDiagnosticReport) for it in report.items)
    assert [[found.code for found in it.items] for it in report.items] == [[], ["G2002"]]
    known = [types.PreviousResultId(it.uri, it.result_id) for it in report.items]
    again = await client.workspace_diagnostic_async(types.WorkspaceDiagnosticParams(known))
    assert all(isinstance(it, types.WorkspaceUnchangedDocumentDiagnosticReport) for it in again.items)
