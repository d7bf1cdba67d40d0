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
import org.h2.mvstore.type.ObjectDataType;

/** Documents as BSON behind a byte that no other type begins with. Those that earlier releases wrote as Java objects are read, too. */
final class DocumentType extends BasicDataType<Document> {
    private static final byte BSON = 127;
    private static final int FIRST_BYTES = 1024;
    /** Of a map, of a member of one, and of a value, about; on the heap of a 64-bit JVM. */
    private static final int DOCUMENT_MEMORY = 160;

    private static final int MEMBER_MEMORY = 96;
    private static final int VALUE_MEMORY = 24;

    private final ObjectDataType javaObjects = new ObjectDataType();

    @Override
    public Document[] createStorage(int size) {
        return new Document[size];
    }

    /** Of a sample the cache would hold many times its size where documents of a mission differ from those before it. */
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
        out.put(BSON).put(bson.nioBuffer());
    }

    @Override
    public Document read(ByteBuffer in) {
        int start = in.position();
        if (in.get(start) != BSON) {
            return (Document) javaObjects.read(in);
        }
        ByteBuf bson = Unpooled.wrappedBuffer(in.position(start + 1));
        Document document = BsonDecoder.decodeBson(bson);
        in.position(start + 1 + bson.readerIndex());
        return document;
    }
}
