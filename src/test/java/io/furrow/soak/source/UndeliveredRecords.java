package io.furrow.soak.source;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import io.furrow.files.Folders;

/** Reads from a worker's log what it left on its disk when it stopped, since its gauges end with it. */
final class UndeliveredRecords {
    private static final Pattern LEFT = Pattern.compile("LeftRecords .*: (\\d+) records in (\\S+) are not in Kafka");
    private static final Pattern JOURNAL = Pattern.compile("\\d+-[0-9a-f]{16}");

    private UndeliveredRecords() {}

    /** The records that its tasks left, by the last line about each journal that still exists. */
    static long records(Path log) throws IOException {
        Map<Path, Long> left = new HashMap<>();
        for (String line : Files.readAllLines(log)) {
            Matcher found = LEFT.matcher(line);
            if (found.find() && Files.isDirectory(Path.of(found.group(2)))) {
                left.put(Path.of(found.group(2)), Long.parseLong(found.group(1)));
            }
        }
        return left.values().stream().mapToLong(Long::longValue).sum();
    }

    /** Inserts a fault. */
    static void deleteJournals(Path disk) throws IOException {
        List<Path> journals = Folders.walk(disk.resolve("journal")).stream()
                .filter(path -> JOURNAL.matcher(path.getFileName().toString()).matches())
                .toList();
        for (Path journal : journals) {
            Folders.delete(journal);
        }
    }
}
