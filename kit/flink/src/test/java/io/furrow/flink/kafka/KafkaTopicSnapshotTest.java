package io.furrow.flink.kafka;

import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.concurrent.atomic.AtomicReference;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.job.TestJob;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

@Timeout(45) // a broker may be silent for a minute unless the properties say otherwise
class KafkaTopicSnapshotTest {
    @Test
    void failsWhenTheBrokerIsSilentForLongerThanTheKafkaPropertiesAllow(@TempDir Path directory) throws Exception {
        Path properties = Files.writeString(directory.resolve("kafka.properties"), "default.api.timeout.ms=300\n");
        try (ServerSocket silent = new ServerSocket(0, 10, InetAddress.getLoopbackAddress())) {
            AtomicReference<JobOptions> options = new AtomicReference<>();
            TestJob.run(
                    options::set,
                    "copy",
                    "--kafka-properties",
                    properties.toString(),
                    "--bootstrap-servers",
                    "127.0.0.1:" + silent.getLocalPort());
            TopicSnapshot topic = new KafkaTopicSnapshot(options.get(), "service.devices");

            assertThatThrownBy(topic::read)
                    .isInstanceOf(IOException.class)
                    .hasMessageContainingAll(
                            "topic service.devices could not be read", "default.api.timeout.ms in --kafka-properties");
            assertThat(silent.isClosed()).isFalse();
        }
    }
}
