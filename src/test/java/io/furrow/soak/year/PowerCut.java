package io.furrow.soak.year;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.List;
import java.util.Random;

import io.furrow.files.Folders;

/**
 * The end of a machine that loses power: of files that were not synced it keeps what was written until some moment of the last
 * second, each of another. Before the end the logs of Kafka are copied one after the other; after it half of them are put back.
 * What is synced with each batch, {@code data.raw} and Kafka's own metadata, is as it was.
 */
record PowerCut(Path kafka, Path copies, Random random) {
    private static final List<String> SYNCED = List.of("data.raw-", "__cluster_metadata");

    /** Within the last second before the end. */
    void copy() throws IOException {
        for (Path partition : partitions(kafka)) {
            Path copy = Files.createDirectories(copies.resolve(partition.getFileName()));
            for (Path log : logs(partition)) {
                try {
                    Files.copy(log, copy.resolve(log.getFileName()), StandardCopyOption.REPLACE_EXISTING);
                } catch (NoSuchFileException e) { // deleted meanwhile
                    continue;
                }
            }
        }
    }

    /** When the process has ended. @return partitions that lost something */
    int putBack() throws IOException {
        int lost = 0;
        for (Path copy : partitions(copies)) {
            Path partition = kafka.resolve(copy.getFileName());
            // A log that was begun meanwhile synced the one before it.
            boolean loses = random.nextBoolean()
                    && Files.isDirectory(partition)
                    && logs(partition).size() == logs(copy).size();
            for (Path log : logs(copy)) {
                Path now = partition.resolve(log.getFileName());
                if (loses && Files.exists(now) && Files.size(now) > Files.size(log)) {
                    Files.copy(log, now, StandardCopyOption.REPLACE_EXISTING);
                    lost++;
                }
                Files.delete(log);
            }
            Files.delete(copy);
        }
        return lost;
    }

    private static List<Path> partitions(Path folder) throws IOException {
        return Folders.list(folder).stream()
                .filter(Files::isDirectory)
                .filter(each -> SYNCED.stream()
                        .noneMatch(synced -> each.getFileName().toString().startsWith(synced)))
                .filter(each -> !each.getFileName().toString().endsWith("-delete"))
                .toList();
    }

    private static List<Path> logs(Path partition) throws IOException {
        return Folders.list(partition).stream()
                .filter(file -> file.getFileName().toString().endsWith(".log"))
                .toList();
    }
}
