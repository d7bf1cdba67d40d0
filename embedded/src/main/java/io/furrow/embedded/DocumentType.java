package io.furrow.embedded;

import java.nio.ByteBuffer;

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
    /** Of a document on the heap, by its bytes in the file. */
    private static final int HEAP_FACTOR = 3;

    private final ObjectDataType javaObjects = new ObjectDataType();
    /** Bytes of a document in the file, the last ones counting most. Of no single one, which would have to be encoded for it. */
    private int averageBytes = 1024;

    @Override
    public Document[] createStorage(int size) {
        return new Document[size];
    }

    @Override
    public int getMemory(Document document) {
        return HEAP_FACTOR * averageBytes;
    }

    @Override
    public void write(WriteBuffer out, Document document) {
        ByteBuf bson = Unpooled.buffer(averageBytes);
        BsonEncoder.encodeDocument(document, bson);
        count(bson.readableBytes());
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
        count(bson.readerIndex());
        in.position(start + 1 + bson.readerIndex());
        return document;
    }

    private void count(int bytes) {
        averageBytes += (bytes - averageBytes) / 16;
    }
}
