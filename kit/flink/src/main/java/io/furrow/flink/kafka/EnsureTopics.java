package io.furrow.flink.kafka;

import java.io.IOException;
import java.util.Properties;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.functions.RichMapFunction;
import org.apache.kafka.clients.CommonClientConfigs;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.DeadLetterCounters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Reason;

/**
 * Forwards records that Kafka accepts: each record, after creating its topic if missing, or, if it is too large for the
 * producer or its topic, its dead letter instead. With an unreachable broker it retries for a minute, then the job fails and is
 * restarted.
 */
public final class EnsureTopics extends RichMapFunction<TopicRecord, TopicRecord> {
    private static final long serialVersionUID = 2L;

    private final Properties client;
    private final Properties producer;
    private final TopicOptions.Settings settings;
    private transient LimitRecordSize writable;
    private transient DeadLetterCounters dead;

    public EnsureTopics(JobOptions options, TopicOptions.Settings settings) {
        this.settings = settings;
        this.producer = KafkaConnectors.producerProperties(options);
        this.client = options.kafkaProperties();
        client.setProperty(CommonClientConfigs.BOOTSTRAP_SERVERS_CONFIG, options.bootstrapServers());
    }

    @Override
    public void open(OpenContext context) {
        writable = writable();
        dead = new DeadLetterCounters(getRuntimeContext().getMetricGroup());
    }

    /** The same outside of an operator. */
    public LimitRecordSize writable() {
        return new LimitRecordSize(new OutputTopics((Properties) client.clone(), settings), SizeLimits.of(producer));
    }

    @Override
    public TopicRecord map(TopicRecord record) throws IOException, InterruptedException {
        TopicRecord taken = writable.of(record);
        if (!taken.topic().equals(record.topic())) {
            dead.count(Reason.TOO_LARGE);
        }
        return taken;
    }

    @Override
    public void close() {
        if (writable != null) {
            writable.close();
        }
    }
}
