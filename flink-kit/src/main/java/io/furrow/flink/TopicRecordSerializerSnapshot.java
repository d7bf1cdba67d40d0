package io.furrow.flink;

import java.io.IOException;

import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.api.common.typeutils.TypeSerializerSchemaCompatibility;
import org.apache.flink.api.common.typeutils.TypeSerializerSnapshot;
import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

/**
 * Says in a savepoint in which form its {@link TopicRecord}s are. What Flink's own serializer of records wrote, before there
 * was {@link TopicRecordSerializer}, is read by it and written anew.
 */
public final class TopicRecordSerializerSnapshot implements TypeSerializerSnapshot<TopicRecord> {
    /** Topic, partition, offset, timestamp, key, value, headers. */
    private static final int VERSION_1 = 1;

    @Override
    public int getCurrentVersion() {
        return VERSION_1;
    }

    @Override
    public void writeSnapshot(DataOutputView out) {
        // the version says it all
    }

    @Override
    public void readSnapshot(int version, DataInputView in, ClassLoader classes) throws IOException {
        if (version != VERSION_1) {
            throw new IOException("records of form " + version + ": this build reads form " + VERSION_1
                    + "; restore the savepoint with the build that wrote it, or a newer one");
        }
    }

    @Override
    public TypeSerializer<TopicRecord> restoreSerializer() {
        return TopicRecordSerializer.INSTANCE;
    }

    @Override
    public TypeSerializerSchemaCompatibility<TopicRecord> resolveSchemaCompatibility(
            TypeSerializerSnapshot<TopicRecord> old) {
        return old instanceof TopicRecordSerializerSnapshot
                ? TypeSerializerSchemaCompatibility.compatibleAsIs()
                : TypeSerializerSchemaCompatibility.compatibleAfterMigration();
    }
}
