"""What the tests share: small scenes, and maps that no cache keeps."""

import pytest

import quadrel


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


@pytest.fixture
def bricks():
    return quadrel.load("bricks-45", {"material.relief.steps": 32}, size=(48, 48))
