package io.furrow.ingest;

import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.JobID;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.files.Folders;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Savepoints of released states of the job, as {@link StoredSavepoint} writes them, each restored by what the job is now. */
@Timeout(120)
class StoredSavepointIT {
    @AutoClose
    private KafkaSuite suite;

    @BeforeEach
    void start(@TempDir Path directory) throws Exception {
        suite = KafkaSuite.start(directory.resolve("kafka"));
        StoredSavepoint.makeTopics(suite);
    }

    @ParameterizedTest
    @MethodSource("releases")
    void isRestoredWithAllThatItKnew(Path savepoint) throws Exception {
        StoredSavepoint.reportBefore(suite); // offsets are as they were, nothing of it is read again
        StoredSavepoint.reportAfter(suite);

        JobID job = suite.run(savepoint.toUri().toString(), "--parallelism", "1", "--topic-partitions", "1");
        List<ConsumerRecord<byte[], byte[]>> farm = suite.awaitRecords("data.farm.realtime", 3);
        List<ConsumerRecord<byte[], byte[]>> latest = suite.awaitRecords(Topics.LATEST, 4);
        suite.cancel(job);

        assertThat(told(farm))
                .as("the repeat is known, the deletion goes where the thermometer was, the robot's history is kept")
                .containsExactly("update camera", "gone thermometer", "before robot");
        assertThat(told(suite.awaitRecords("data.farm.realtime.weeding", 3)))
                .containsExactly("update camera", "gone thermometer", "before robot");
        Entity camera = Entity.parse(latest.get(0).value());
        assertThat(camera.number("Latitude")).as("from the state").contains(40.0);
        assertThat(camera.number("Longitude")).contains(-3.0);
        assertThat(latest).extracting(ConsumerRecord::value).element(1).isNull();
    }

    private static List<Path> releases() throws IOException {
        return Folders.list(StoredSavepoint.FOLDER);
    }

    private static List<String> told(List<ConsumerRecord<byte[], byte[]>> records) {
        List<String> told = new ArrayList<>();
        records.forEach(record ->
                told.add(KafkaSuite.headers(record).get(HeaderNames.CE_ID) + " " + new String(record.key(), UTF_8)));
        return told;
    }
}
