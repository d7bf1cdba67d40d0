package io.furrow.flink.device;

import java.nio.charset.StandardCharsets;

import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/** Parses the records of {@code service.devices}; emits dead letters for invalid ones. */
public final class ParseDevices extends ProcessFunction<TopicRecord, DeviceChange> {
    private static final long serialVersionUID = 1L;

    private final String stage;

    /** @param stage name of the job in dead letters, for instance {@code ingest} */
    public ParseDevices(String stage) {
        this.stage = stage;
    }

    @Override
    public void processElement(TopicRecord record, Context context, Collector<DeviceChange> out) {
        try {
            out.collect(read(record));
        } catch (UnreadableException e) {
            context.output(DeadLetters.TAG, DeadLetters.of(record, e, stage));
        }
    }

    static DeviceChange read(TopicRecord record) throws UnreadableException {
        if (record.value() != null) {
            DeviceVersion version = DeviceVersion.read(record.value());
            return new DeviceChange(version.key(), record.partition(), record.offset(), record.timestamp(), version);
        }
        Reason.NOT_AN_EVENT.refuseIf(record.key() == null, "the record has neither a value nor a key");
        return new DeviceChange(
                new String(record.key(), StandardCharsets.UTF_8),
                record.partition(),
                record.offset(),
                record.timestamp(),
                null);
    }
}
