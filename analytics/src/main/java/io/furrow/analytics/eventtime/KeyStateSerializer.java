package io.furrow.analytics.eventtime;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.flink.format.VersionedSerializer;

/** Serializes a {@link KeyState}; a subclass provides the serializers of its messages and its state. */
public abstract class KeyStateSerializer<M extends HasEventTime, S> extends VersionedSerializer<KeyState<M, S>> {
    private static final long serialVersionUID = 1L;
    /** Number of messages, messages as parts, whether there is state, the state as a part. */
    private static final int VERSION = 3;

    private final VersionedSerializer<M> messages;
    private final VersionedSerializer<S> remembered;

    protected KeyStateSerializer(VersionedSerializer<M> messages, VersionedSerializer<S> remembered) {
        this.messages = messages;
        this.remembered = remembered;
    }

    @Override
    @SuppressWarnings("unchecked") // there is no class literal of a generic type
    public final Class<KeyState<M, S>> type() {
        return (Class<KeyState<M, S>>) (Class<?>) KeyState.class;
    }

    @Override
    public final int version() {
        return VERSION;
    }

    @Override
    public final void write(KeyState<M, S> keyState, DataOutputView out) throws IOException {
        out.writeInt(keyState.waiting.size());
        for (M message : keyState.waiting) {
            messages.writePart(message, out);
        }
        out.writeBoolean(keyState.remembered != null);
        if (keyState.remembered != null) {
            remembered.writePart(keyState.remembered, out);
        }
    }

    @Override
    public final KeyState<M, S> read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        KeyState<M, S> keyState = new KeyState<>();
        for (int left = in.readInt(); left > 0; left--) {
            keyState.waiting.add(messages.readPart(in));
        }
        if (in.readBoolean()) {
            keyState.remembered = remembered.readPart(in);
        }
        return keyState;
    }

    @Override
    public final KeyState<M, S> copy(KeyState<M, S> keyState) {
        KeyState<M, S> copy = new KeyState<>();
        copy.waiting.addAll(keyState.waiting);
        copy.remembered = keyState.remembered == null ? null : remembered.copy(keyState.remembered);
        return copy;
    }

    @Override
    public final boolean isImmutable() {
        return false;
    }
}
