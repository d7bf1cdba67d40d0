package io.furrow.launcher.option;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

import io.furrow.dashboard.page.PageSettings;

/** Option for the base maps of the page. */
public final class TileFlags {
    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--tiles",
            paramLabel = "URL|FILE",
            description =
                    "Map tiles to draw below the fields: a URL with {z}, {x} and {y}, for instance https://tiles.example.org/{z}/{x}/{y}.png, or a PMTiles file with pictures, which needs no internet. Given twice, one of each: users choose on the map. Default: none.")
    private List<String> tiles = List.of();

    /** @param folder as of {@link PageSettings} */
    public PageSettings page(Path folder, List<Path> images) {
        String url = only(true);
        String file = only(false);
        if (url != null && !url.contains("{z}")) {
            throw new ParameterException(
                    spec.commandLine(), "--tiles %s names no tile: a URL has {z}, {x} and {y}.".formatted(url));
        }
        if (file != null && !Files.isReadable(Path.of(file))) {
            throw new ParameterException(
                    spec.commandLine(), "--tiles %s: there is no such file, or it cannot be read.".formatted(file));
        }
        return new PageSettings(folder, url, file == null ? null : Path.of(file), images);
    }

    /** Returns the URL, or the file; null if there is none. */
    private String only(boolean url) {
        List<String> found = tiles.stream()
                .filter(each -> url == each.matches("https?://.*"))
                .toList();
        if (found.size() > 1) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--tiles %s: give one %s only.".formatted(String.join(", ", found), url ? "URL" : "file"));
        }
        return found.isEmpty() ? null : found.get(0);
    }
}
