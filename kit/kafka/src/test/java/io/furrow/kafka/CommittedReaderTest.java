package io.furrow.kafka;

import java.lang.management.ManagementFactory;
import java.util.Properties;
import javax.management.ObjectName;

import org.apache.kafka.common.errors.TimeoutException;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.FreePort;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class CommittedReaderTest {
    @Test
    void leavesNoConsumerBehindWhileKafkaIsUnavailable() throws Exception {
        Properties client = new Properties();
        client.put("bootstrap.servers", "127.0.0.1:" + FreePort.orFree(0));
        client.put("client.id", "committed-reader-test");
        client.put("default.api.timeout.ms", "200");

        assertThatThrownBy(() -> CommittedReader.open(client, "service.replays"))
                .isInstanceOf(TimeoutException.class);

        ObjectName consumer = new ObjectName("kafka.consumer:type=app-info,id=committed-reader-test");
        assertThat(ManagementFactory.getPlatformMBeanServer().isRegistered(consumer))
                .isFalse();
    }
}
