package io.furrow.analytics.eventtime;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.flink.format.Format;

/** How a {@link Pending} is written; a subclass says what its messages and its remembered value are. */
public abstract class PendingFormat<M extends Timed, S> extends Format<Pending<M, S>> {
    private static final long serialVersionUID = 1L;
    /** Number of messages, messages as parts, whether something is remembered, what it is as a part. */
    private static final int VERSION = 3;

    private final Format<M> messages;
    private final Format<S> remembered;

    protected PendingFormat(Format<M> messages, Format<S> remembered) {
        this.messages = messages;
        this.remembered = remembered;
    }

    @Override
    @SuppressWarnings("unchecked") // there is no class literal of a generic type
    public final Class<Pending<M, S>> type() {
        return (Class<Pending<M, S>>) (Class<?>) Pending.class;
    }

    @Override
    public final int version() {
        return VERSION;
    }

    @Override
    public final void write(Pending<M, S> pending, DataOutputView out) throws IOException {
        out.writeInt(pending.waiting.size());
        for (M message : pending.waiting) {
            messages.writePart(message, out);
        }
        out.writeBoolean(pending.remembered != null);
        if (pending.remembered != null) {
            remembered.writePart(pending.remembered, out);
        }
    }

    @Override
    public final Pending<M, S> read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        Pending<M, S> pending = new Pending<>();
        for (int left = in.readInt(); left > 0; left--) {
            pending.waiting.add(messages.readPart(in));
        }
        if (in.readBoolean()) {
            pending.remembered = remembered.readPart(in);
        }
        return pending;
    }

    @Override
    public final Pending<M, S> copy(Pending<M, S> pending) {
        Pending<M, S> copy = new Pending<>();
        copy.waiting.addAll(pending.waiting);
        copy.remembered = pending.remembered == null ? null : remembered.copy(pending.remembered);
        return copy;
    }

    @Override
    public final boolean isImmutable() {
        return false;
    }
}
