package io.furrow.model.ngsi;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * A request of a context broker (Orion 4.7), recorded from the wire; the files under {@code orion/}.
 *
 * @param name {@code <cause>/<form>}: an entity was created, patched, or sent by {@code forcedUpdate}
 */
public record RecordedNotification(String name, String attrsFormat, byte[] body) {
    private static final Path FOLDER = Path.of("src/test/resources/orion");
    private static final String FORMAT_HEADER = "Ngsiv2-AttrsFormat: ";

    public static List<RecordedNotification> all() {
        try (Stream<Path> files = Files.walk(FOLDER)) {
            return files.filter(file -> file.toString().endsWith(".http"))
                    .sorted()
                    .map(RecordedNotification::of)
                    .toList();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    public static RecordedNotification named(String name) {
        return all().stream().filter(each -> each.name.equals(name)).findFirst().orElseThrow();
    }

    @Override
    public String toString() {
        return name;
    }

    private static RecordedNotification of(Path file) {
        try {
            String[] headAndBody = Files.readString(file).split("\r?\n\r?\n", 2);
            String format = headAndBody[0]
                    .lines()
                    .filter(line -> line.startsWith(FORMAT_HEADER))
                    .findFirst()
                    .orElseThrow()
                    .substring(FORMAT_HEADER.length());
            String form = file.getFileName().toString().replaceFirst("-\\d+\\.http$", "");
            String cause = file.getParent().getFileName().toString();
            return new RecordedNotification(
                    cause + "/" + form, format, headAndBody[1].strip().getBytes(UTF_8));
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }
}
