package io.furrow.flink;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.concurrent.atomic.AtomicReference;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class KafkaEndsTest {
    @TempDir
    private Path directory;

    @Test
    void haveOneRequestUnderWaySoThatANewTopicStallsNoProducer() {
        assertThat(KafkaEnds.producerProperties(parsed("copy")))
                .containsEntry("max.in.flight.requests.per.connection", "1");
    }

    @Test
    void letTheFileOfKafkaPropertiesPrevail() throws Exception {
        Path file = Files.writeString(
                directory.resolve("kafka.properties"), "max.in.flight.requests.per.connection=5\nbatch.size=1\n");

        assertThat(KafkaEnds.producerProperties(parsed("copy", "--kafka-properties", file.toString())))
                .containsEntry("max.in.flight.requests.per.connection", "5")
                .containsEntry("batch.size", "1")
                .containsKey("max.request.size");
    }

    private static JobOptions parsed(String... arguments) {
        AtomicReference<JobOptions> parsed = new AtomicReference<>();
        assertThat(TestJob.run(parsed::set, arguments).exitCode()).isZero();
        return parsed.get();
    }
}
