package io.furrow.flink.kafka;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;
import java.util.concurrent.atomic.AtomicReference;

import org.apache.flink.api.common.eventtime.WatermarkAlignmentParams;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.flink.job.AlignmentOptions;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.job.TestJob;

import static org.assertj.core.api.Assertions.assertThat;

class KafkaConnectorsTest {
    @Test
    void haveOneRequestUnderWaySoThatANewTopicStallsNoProducer() {
        assertThat(KafkaConnectors.producerProperties(parsed("copy")))
                .containsEntry("max.in.flight.requests.per.connection", "1");
    }

    @Test
    void letTheFileOfKafkaPropertiesPrevail(@TempDir Path directory) throws Exception {
        Path file = Files.writeString(
                directory.resolve("kafka.properties"),
                "max.in.flight.requests.per.connection=5\nbatch.size=1\npartition.discovery.interval.ms=7\n");

        assertThat(KafkaConnectors.producerProperties(parsed("copy", "--kafka-properties", file.toString())))
                .containsAllEntriesOf(Map.of("max.in.flight.requests.per.connection", "5", "batch.size", "1"))
                .containsKey("max.request.size");
        assertThat(KafkaConnectors.consumerProperties(parsed("copy", "--kafka-properties", file.toString())))
                .containsEntry("partition.discovery.interval.ms", "7")
                .containsEntry("isolation.level", "read_committed");
    }

    @Test
    void compressUnlessTheFileOfKafkaPropertiesSaysOtherwise(@TempDir Path directory) throws Exception {
        Path file = Files.writeString(directory.resolve("kafka.properties"), "compression.type=none\n");

        assertThat(KafkaConnectors.producerProperties(parsed("copy"))).containsEntry("compression.type", "lz4");
        assertThat(KafkaConnectors.producerProperties(parsed("copy", "--kafka-properties", file.toString())))
                .containsEntry("compression.type", "none");
    }

    @Test
    void letNoPartitionRunAheadUnlessThatIsSwitchedOff() {
        assertThat(alignment().isEnabled()).isTrue();
        assertThat(alignment().getMaxAllowedWatermarkDrift()).isEqualTo(120_000);
        assertThat(alignment("--max-drift", "5s").getMaxAllowedWatermarkDrift()).isEqualTo(5_000);
        assertThat(alignment("--max-drift", "0s").isEnabled()).isFalse();
    }

    private static WatermarkAlignmentParams alignment(String... arguments) {
        AlignmentOptions options = new AlignmentOptions();
        JobCommandLine.of(options).parseArgs(arguments);
        return KafkaConnectors.watermarks(parsed("copy"), options.maxDrift()).getAlignmentParameters();
    }

    private static JobOptions parsed(String... arguments) {
        AtomicReference<JobOptions> parsed = new AtomicReference<>();
        assertThat(TestJob.run(parsed::set, arguments).exitCode()).isZero();
        return parsed.get();
    }
}
