package io.furrow.control.alarm;

import java.time.Clock;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.audit.AuditEntry;
import io.furrow.model.topic.Topics;

/** What is done when alarms change: a webhook is told, robots are stopped. Several instances share the work. */
public final class AlarmActions implements AutoCloseable {
    private static final String WEBHOOK = "furrow-alarm-webhook";
    private static final String STOP = "furrow-stop-on-predicted";

    private static final Logger LOG = LoggerFactory.getLogger(AlarmActions.class);

    private final List<AlarmFollower> followers = new ArrayList<>();
    private final KafkaProducer<String, byte[]> audit;

    private AlarmActions(KafkaProducer<String, byte[]> audit) {
        this.audit = audit;
    }

    /**
     * @param client settings of Kafka clients
     * @param webhook null for none
     * @param stop null to stop nothing
     */
    public static AlarmActions start(Properties client, Webhook.Settings webhook, StopRobots.Settings stop) {
        KafkaProducer<String, byte[]> audit =
                stop == null ? null : new KafkaProducer<>(client, new StringSerializer(), new ByteArraySerializer());
        AlarmActions actions = new AlarmActions(audit);
        if (webhook != null) {
            actions.followers.add(AlarmFollower.start(WEBHOOK, client, new Webhook(webhook, Clock.systemUTC())));
        }
        if (stop != null) {
            StopRobots robots = new StopRobots(stop, actions::note, Clock.systemUTC());
            actions.followers.add(AlarmFollower.start(STOP, client, robots));
        }
        return actions;
    }

    /** Comes back when it is on the topic, or cannot come there. */
    private void note(AuditEntry entry) {
        audit.send(new ProducerRecord<>(Topics.AUDIT, entry.toBytes()), (written, failure) -> {
            if (failure != null) {
                LOG.error("not on the audit topic: {} {}, {}", entry.command(), entry.about(), entry.result(), failure);
            }
        });
        audit.flush();
    }

    @Override
    public void close() {
        followers.forEach(AlarmFollower::close);
        if (audit != null) {
            audit.close();
        }
    }
}
