package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.List;

import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.EntityUpdates.Update;

/** Writes updates in batches; where a batch is refused each of its entities is tried alone, so that one harms no other. */
final class EntityWriter {
    /** An update that the context broker does not take, and its words. */
    record RefusedUpdate(Update update, String words) {}

    /** The context broker cannot be reached, or says to come again; what was written before may be written again. */
    static final class AwayException extends Exception {
        private static final long serialVersionUID = 1L;

        AwayException(Outcome.Away away) {
            super(away.reason(), away.cause());
        }
    }

    /** No request can succeed until a setting is changed. */
    static final class WrongSettingException extends Exception {
        private static final long serialVersionUID = 1L;

        WrongSettingException(Outcome.WrongSetting wrong) {
            super(wrong.words());
        }
    }

    private final ContextBroker broker;
    private final Batches batches;

    EntityWriter(ContextBroker broker, Batches batches) {
        this.broker = broker;
        this.batches = batches;
    }

    /** Returns the updates that were refused; all others are written. */
    List<RefusedUpdate> write(List<Update> updates) throws AwayException, WrongSettingException {
        List<RefusedUpdate> refused = new ArrayList<>();
        for (List<Update> batch : batches.cut(updates)) {
            writeOrIsolate(batch, refused);
        }
        return refused;
    }

    private void writeOrIsolate(List<Update> batch, List<RefusedUpdate> refused)
            throws AwayException, WrongSettingException {
        Outcome outcome = broker.append(batch.get(0).scope(), batch);
        if (outcome instanceof Outcome.Away away) {
            throw new AwayException(away);
        } else if (outcome instanceof Outcome.WrongSetting wrong) {
            throw new WrongSettingException(wrong);
        } else if (outcome instanceof Outcome.Refused refusal && batch.size() == 1) {
            refused.add(new RefusedUpdate(batch.get(0), refusal.words()));
        } else if (outcome instanceof Outcome.Refused) {
            for (Update update : batch) {
                writeOrIsolate(List.of(update), refused);
            }
        }
    }
}
