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
 * Simulates the power loss of a machine: files that were not synced have the content of some moment in the last second,
 * each of another one. Copies the logs of Kafka one after the other before the end, and restores half of them
 * afterwards. Logs that are synced with each batch, {@code data.raw} and Kafka's metadata, are not changed.
 */
record PowerCut(Path kafka, Path copies, Random random) {
    private static final List<String> SYNCED = List.of("data.raw-", "__cluster_metadata");

    /** Copies the logs, within the last second before the end. */
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

    /** Restores copies after the process has ended. @return the number of partitions that lost records */
    int restoreCopies() throws IOException {
        int lost = 0;
        for (Path copy : partitions(copies)) {
            Path partition = kafka.resolve(copy.getFileName());
            // when a new segment began, the previous one was synced
            boolean loses = random.nextBoolean()
                    && Files.isDirectory(partition)
                    && logs(partition).size() == logs(copy).size();
            for (Path log : logs(copy)) {
                Path current = partition.resolve(log.getFileName());
                if (loses && Files.exists(current) && Files.size(current) > Files.size(log)) {
                    Files.copy(log, current, StandardCopyOption.REPLACE_EXISTING);
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
