package io.furrow.connect.source.journal;

import java.util.Arrays;

import io.furrow.connect.record.KafkaRecord;

/** What a fuzzer throws at the reading of a journal's payloads: it is a record, written again as the same, or refused. */
public final class FuzzRecords {
    private FuzzRecords() {}

    /** Called by the fuzzer first: loading classes takes long on a busy machine, and no input hangs because of it. */
    public static void fuzzerInitialize() {
        fuzzerTestOneInput(new byte[] {1});
    }

    /** One payload; throws whatever is wrong. */
    public static void fuzzerTestOneInput(byte[] payload) {
        KafkaRecord record;
        try {
            record = JournalRecordCodec.read(payload);
        } catch (IllegalArgumentException refused) {
            return;
        }
        KafkaRecord again = JournalRecordCodec.read(JournalRecordCodec.write(record));
        if (!again.headers().equals(record.headers()) || !Arrays.equals(again.value(), record.value())) {
            throw new IllegalStateException("read differently the second time");
        }
    }
}
