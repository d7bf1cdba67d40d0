package io.furrow.control.health;

import java.time.Duration;
import java.util.Set;

import org.apache.kafka.streams.processor.PunctuationType;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.manager.RecordScope;
import io.furrow.control.manager.StateJson;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Listens to what devices report, one {@link Listener} per partition, which is not remembered: whoever takes a partition over
 * begins anew, and {@link HealthDesk} misses those that fell silent meanwhile.
 *
 * <p><b>Passed over</b>: deletions, and what was read from the context broker to mend a gap, which is no sign of life.
 */
final class HearDevices extends ContextualProcessor<String, byte[], String, byte[]> {
    private static final Logger LOG = LoggerFactory.getLogger(HearDevices.class);
    private static final Duration TICK = Duration.ofSeconds(1);
    /** How exactly it is known since when nothing arrives. */
    private static final Duration PULSE = Duration.ofSeconds(5);

    private static final Set<String> ATTRIBUTES = Set.of(Battery.ATTRIBUTE, Listener.STATUS);

    private final HealthOptions options;
    private Listener listener;
    private long pulsed;

    HearDevices(HealthOptions options) {
        this.options = options;
    }

    @Override
    public void init(ProcessorContext<String, byte[]> context) {
        super.init(context);
        listener = new Listener(options, HealthWatch.wanted(context), this::forward);
        context.schedule(TICK, PunctuationType.WALL_CLOCK_TIME, listener::passTime);
    }

    @Override
    public void process(Record<String, byte[]> record) {
        boolean mended = Origin.REPAIR.code().equals(RecordScope.header(record, HeaderNames.ORIGIN));
        if (record.key() == null || record.value() == null || mended) {
            return;
        }
        String key = RecordScope.of(record).identity(record.key());
        if (!listener.listensTo(key)) {
            return;
        }
        try {
            Entity entity = Entity.parse(record.value(), ATTRIBUTES);
            long now = context().currentSystemTimeMs();
            if (listener.hear(key, entity, record.timestamp(), now) && now - pulsed >= PULSE.toMillis()) {
                pulsed = now;
                forward(Sign.PULSE_KEY, Sign.pulse(now));
            }
        } catch (UnreadableException e) {
            LOG.debug("a report of {} cannot be read", record.key(), e);
        }
    }

    private void forward(String key, Sign sign) {
        context().forward(new Record<>(key, StateJson.write(sign), context().currentSystemTimeMs()));
    }
}
