package io.furrow.control.health;

import java.time.Duration;

import org.apache.kafka.streams.processor.PunctuationType;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.KafkaClients;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.time.Elapsed;

/**
 * Derives heartbeats from the reports of devices, with one {@link SilenceDetector} per partition. The detector is not
 * persisted: after a reassignment it starts again, and {@link DeviceHealthTracker} finds the devices that fell silent
 * meanwhile.
 *
 * <p><b>Skipped</b>: deletions, and entities that were read from the context broker to repair a gap, which are not
 * heartbeats.
 */
final class HeartbeatProcessor extends ContextualProcessor<String, byte[], String, byte[]> {
    private static final Logger LOG = LoggerFactory.getLogger(HeartbeatProcessor.class);
    private static final Duration TICK = Duration.ofSeconds(1);
    /** Resolution of the time since which no report has arrived. */
    private static final Duration PULSE = Duration.ofSeconds(5);

    private final HealthOptions options;
    private SilenceDetector detector;
    private long pulsed;

    HeartbeatProcessor(HealthOptions options) {
        this.options = options;
    }

    @Override
    public void init(ProcessorContext<String, byte[]> context) {
        super.init(context);
        detector = new SilenceDetector(options, HealthWatch.desired(context), this::forward);
        context.schedule(TICK, PunctuationType.WALL_CLOCK_TIME, detector::passTime);
    }

    @Override
    public void process(Record<String, byte[]> record) {
        boolean repaired = Origin.REPAIR.code().equals(KafkaClients.text(record.headers(), HeaderNames.ORIGIN));
        if (record.key() == null || record.value() == null || repaired) {
            return;
        }
        String key = KafkaClients.scope(record.headers()).identity(record.key());
        if (!detector.isMonitored(key)) {
            return;
        }
        try {
            Entity entity = Entity.parse(record.value());
            long now = context().currentSystemTimeMs();
            if (detector.process(key, entity, record.timestamp(), now)
                    && Elapsed.hasPassed(PULSE.toMillis(), pulsed, now)) {
                pulsed = now;
                forward(Heartbeat.PULSE_KEY, Heartbeat.pulse(now));
            }
        } catch (UnreadableException e) {
            LOG.debug("report of {} cannot be parsed and is skipped", record.key(), e);
        }
    }

    private void forward(String key, Heartbeat heartbeat) {
        context()
                .forward(new Record<>(key, StateJson.write(heartbeat), context().currentSystemTimeMs()));
    }
}
