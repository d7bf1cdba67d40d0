package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;

/** How {@link Arrivals} are written. */
public final class ArrivalsFormat extends Format<Arrivals> {
    private static final long serialVersionUID = 1L;
    /** Number of arrivals, tombstones included; arrivals in their version 1. */
    private static final int VERSION = 1;

    private static final int ARRIVAL_VERSION = 1;

    private final ArrivalFormat arrivals = new ArrivalFormat();

    @Override
    public Class<Arrivals> type() {
        return Arrivals.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(Arrivals all, DataOutputView out) throws IOException {
        out.writeInt(all.all().size());
        for (Arrival arrival : all.all()) {
            arrivals.write(arrival, out);
        }
    }

    @Override
    public Arrivals read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        Arrivals all = new Arrivals();
        for (int left = in.readInt(); left > 0; left--) {
            all.put(arrivals.read(ARRIVAL_VERSION, in));
        }
        return all;
    }

    @Override
    public Arrivals copy(Arrivals all) {
        Arrivals copy = new Arrivals();
        all.all().forEach(copy::put);
        return copy;
    }

    @Override
    public boolean isImmutable() {
        return false;
    }
}
