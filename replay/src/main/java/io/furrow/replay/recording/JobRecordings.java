package io.furrow.replay.recording;

import java.io.IOException;
import java.util.Optional;

import io.furrow.mission.Recording;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingException;
import io.furrow.mission.Recordings;
import io.furrow.mission.file.FileRecordings;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.file.FileProblem;

/**
 * Opens stored missions and the other sources of a replay: a file of the job's folder, a topic.
 *
 * @param folder folder of exported missions on any file system of Flink; null if files may not be played
 * @param topics opens a topic as a recording
 */
public record JobRecordings(Recordings missions, String folder, TopicHistories topics) implements RecordingSources {
    private static final FlinkFiles FILES = new FlinkFiles();

    @Override
    public Optional<Recording> open(DesiredReplay replay) throws RecordingException {
        ReplayPlan.Source source = replay.plan().source();
        if (source == null) {
            return missions.open(replay.mission());
        } else if (source.topic() != null) {
            return topics.open(source.topic(), replay);
        }
        if (folder == null) {
            throw new RecordingDeletedException(
                    "the file '%s' cannot be played: the job has no folder of recordings; start it with --recordings"
                            .formatted(source.file()));
        }
        return ofFile(folder + "/" + source.file(), replay.mission());
    }

    private static Optional<Recording> ofFile(String path, String mission) throws RecordingException {
        try {
            return FILES.exists(path) ? new FileRecordings(path, FILES).open(mission) : Optional.empty();
        } catch (IOException e) {
            throw new RecordingException("The file %s cannot be read: %s".formatted(path, FileProblem.of(e)), e);
        }
    }
}
