package io.furrow.flink.format;

import java.io.IOException;

import org.apache.flink.api.common.serialization.SerializerConfigImpl;
import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.api.common.typeutils.TypeSerializerSnapshot;
import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputSerializer;
import org.apache.flink.core.memory.DataOutputView;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class VersionedSerializerTest {
    /** Version 1: the text. Version 2: before it, a number that older ones took for 7. */
    record Note(int number, String text) {}

    /** How a note is written. */
    public static final class NoteFormat extends VersionedSerializer<Note> {
        private static final long serialVersionUID = 1L;

        @Override
        public Class<Note> type() {
            return Note.class;
        }

        @Override
        public int version() {
            return 2;
        }

        @Override
        public void write(Note note, DataOutputView out) throws IOException {
            out.writeInt(note.number);
            StringCodec.write(note.text, out);
        }

        @Override
        public Note read(int version, DataInputView in) throws IOException {
            return switch (version) {
                case 1 -> new Note(7, StringCodec.read(in));
                case 2 -> new Note(in.readInt(), StringCodec.read(in));
                default -> throw unknown(version);
            };
        }
    }

    @Test
    void readsWhatAnOlderVersionWroteAndHasItWrittenInTheNewest() throws Exception {
        DataOutputSerializer old = new DataOutputSerializer(32);
        StringCodec.write("kept", old);
        TypeSerializerSnapshot<Note> savepoint = savepointOf(1);
        assertThat(savepoint.restoreSerializer().deserialize(input(old))).isEqualTo(new Note(7, "kept"));
        TypeSerializer<Note> newest = newest();
        assertThat(newest.snapshotConfiguration()
                        .resolveSchemaCompatibility(savepoint)
                        .isCompatibleAfterMigration())
                .isTrue();
        assertThat(newest.snapshotConfiguration()
                        .resolveSchemaCompatibility(savepointOf(2))
                        .isCompatibleAsIs())
                .isTrue();
        DataOutputSerializer out = new DataOutputSerializer(32);
        newest.serialize(new Note(8, "new"), out);
        assertThat(savepointOf(2).restoreSerializer().deserialize(input(out))).isEqualTo(new Note(8, "new"));
    }

    @Test
    void refusesASavepointOfANewerRelease() {
        assertThatThrownBy(() -> savepointOf(3))
                .isInstanceOf(IOException.class)
                .hasMessage("Note was written in version 3, this release writes 2; use the release that wrote it, or"
                        + " start without the savepoint");
    }

    @ParameterizedTest
    @ValueSource(ints = {0, 1, 254, 255, 256, 70_000})
    void writesTextsOfAnyLength(int length) throws Exception {
        String text = "é".repeat(length / 2) + "x".repeat(length % 2);
        DataOutputSerializer out = new DataOutputSerializer(32);
        StringCodec.write(text, out);
        DataInputDeserializer in = input(out);
        assertThat(StringCodec.read(in)).isEqualTo(text);
        assertThat(in.available()).isZero();
    }

    private static TypeSerializer<Note> newest() {
        return new VersionedTypeInfo<>(new NoteFormat()).createSerializer(new SerializerConfigImpl());
    }

    /** What a savepoint says that was written with a version of the format. */
    private static TypeSerializerSnapshot<Note> savepointOf(int version) throws IOException {
        DataOutputSerializer out = new DataOutputSerializer(64);
        out.writeUTF(NoteFormat.class.getName());
        out.writeInt(version);
        VersionedSerializerSnapshot<Note> snapshot = new VersionedSerializerSnapshot<>();
        snapshot.readSnapshot(1, input(out), VersionedSerializerTest.class.getClassLoader());
        return snapshot;
    }

    private static DataInputDeserializer input(DataOutputSerializer written) {
        return new DataInputDeserializer(written.getCopyOfBuffer());
    }
}
