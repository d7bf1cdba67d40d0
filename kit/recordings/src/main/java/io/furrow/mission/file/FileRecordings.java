package io.furrow.mission.file;

import java.io.IOException;
import java.util.Collection;
import java.util.List;
import java.util.Optional;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import io.furrow.mission.Recording;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingException;
import io.furrow.mission.Recordings;
import io.furrow.mission.marker.MarkerFile;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.model.file.FileProblem;
import io.furrow.model.topic.TopicName;

/**
 * Opens missions in files of {@linkplain ArchiveLine lines}, compressed if the name ends in {@code .gz}: a single
 * exported file, which stands for any mission, or a folder with {@code <mission>.ndjson} or {@code .jsonl}, or with an
 * archive's folder {@code mission_<mission>}. A {@link MarkerFile} is not a mission.
 *
 * @param path of the file or folder
 */
public record FileRecordings(String path, RecordingFiles files) implements Recordings {
    private static final List<String> ENDINGS = List.of(".ndjson", ".ndjson.gz", ".jsonl", ".jsonl.gz");

    /** Opens missions in local files. */
    public FileRecordings(String path) {
        this(path, RecordingFiles.LOCAL);
    }

    @Override
    public Optional<Recording> open(String mission) throws RecordingException {
        try {
            if (!files.exists(path)) {
                throw new RecordingException("There is no file or folder %s with mission %s".formatted(path, mission));
            }
            if (MarkerFile.isOne(path)) {
                throw new RecordingDeletedException(
                        "%s holds markers and no events; name the file of the mission, which lies beside it"
                                .formatted(path));
            }
            if (!files.isFolder(path)) {
                return Optional.of(new FileRecording(mission, files, List.of(List.of(path))));
            }
            List<String> names = files.names(path);
            Optional<String> file = exported(mission, names);
            if (file.isPresent()) {
                return Optional.of(new FileRecording(mission, files, List.of(List.of(path + "/" + file.get()))));
            }
            for (String folder : MissionCollections.candidates(mission)) {
                if (names.contains(folder)) {
                    return Optional.of(new FileRecording(mission, files, days(path + "/" + folder)));
                }
            }
            return Optional.empty();
        } catch (RecordingException e) {
            throw e;
        } catch (IOException e) {
            throw new RecordingException(
                    "Mission %s cannot be read from %s: %s".formatted(mission, path, FileProblem.of(e)), e);
        }
    }

    private static Optional<String> exported(String mission, List<String> names) {
        return Stream.of(mission, TopicName.of(mission))
                .flatMap(name -> ENDINGS.stream().map(ending -> name + ending))
                .filter(name -> names.contains(name) && !MarkerFile.isOne(name))
                .findFirst();
    }

    /** Returns the files of each day of an archive, in the order of days. */
    private List<List<String>> days(String folder) throws IOException {
        Collection<List<String>> days = files.names(folder).stream()
                .filter(name -> name.length() > ArchiveFiles.LENGTH_OF_DAY
                        && ENDINGS.stream().anyMatch(name::endsWith)
                        && !MarkerFile.isOne(name))
                .collect(Collectors.groupingBy(
                        name -> name.substring(0, ArchiveFiles.LENGTH_OF_DAY),
                        TreeMap::new,
                        Collectors.mapping(name -> folder + "/" + name, Collectors.toList())))
                .values();
        return List.copyOf(days);
    }
}
