package io.furrow.embedded;

import java.nio.ByteBuffer;
import java.util.Collection;

import de.bwaldvogel.mongo.bson.BinData;
import de.bwaldvogel.mongo.bson.Document;
import de.bwaldvogel.mongo.wire.bson.BsonDecoder;
import de.bwaldvogel.mongo.wire.bson.BsonEncoder;
import io.netty.buffer.ByteBuf;
import io.netty.buffer.Unpooled;
import org.h2.mvstore.WriteBuffer;
import org.h2.mvstore.type.BasicDataType;

/** Serializes documents as BSON. */
final class DocumentType extends BasicDataType<Document> {
    private static final int FIRST_BYTES = 1024;
    /** Approximate heap sizes of a map, its member and a value, on a 64-bit JVM. */
    private static final int DOCUMENT_MEMORY = 160;

    private static final int MEMBER_MEMORY = 96;
    private static final int VALUE_MEMORY = 24;

    @Override
    public Document[] createStorage(int size) {
        return new Document[size];
    }

    /** False: with estimates from samples the cache would hold many times its size if documents of missions differ. */
    @Override
    public boolean isMemoryEstimationAllowed() {
        return false;
    }

    @Override
    public int getMemory(Document document) {
        return memory(document);
    }

    private static int memory(Object value) {
        int memory = VALUE_MEMORY;
        if (value instanceof Document document) {
            memory = DOCUMENT_MEMORY;
            for (Object member : document.values()) {
                memory += MEMBER_MEMORY + memory(member);
            }
        } else if (value instanceof Collection<?> list) {
            for (Object element : list) {
                memory += memory(element);
            }
        } else if (value instanceof String text) {
            memory += VALUE_MEMORY + text.length();
        } else if (value instanceof BinData bytes) {
            memory += bytes.getData().length;
        }
        return memory;
    }

    @Override
    public void write(WriteBuffer out, Document document) {
        ByteBuf bson = Unpooled.buffer(FIRST_BYTES);
        BsonEncoder.encodeDocument(document, bson);
        out.put(bson.nioBuffer());
    }

    @Override
    public Document read(ByteBuffer in) {
        ByteBuf bson = Unpooled.wrappedBuffer(in);
        Document document = BsonDecoder.decodeBson(bson);
        in.position(in.position() + bson.readerIndex());
        return document;
    }
}
