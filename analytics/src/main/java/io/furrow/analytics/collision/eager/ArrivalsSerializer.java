package io.furrow.analytics.collision.eager;

import java.io.IOException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.collision.grid.CellSerializer;
import io.furrow.analytics.collision.matching.Shortlist;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.DeviceSerializer;
import io.furrow.flink.format.Format;

/** How {@link Arrivals} are written. */
public final class ArrivalsSerializer extends Format<Arrivals> {
    private static final long serialVersionUID = 1L;
    /**
     * Number of arrivals, tombstones included; arrivals as parts; number of shortlists; of each the device as a part and the list.
     * In version 2 parts are without their version, which was 1; in version 1 the lists are missing, too.
     */
    private static final int VERSION = 3;

    private static final int WITHOUT_VERSIONS = 2;
    private static final int WITHOUT_SHORTLISTS = 1;

    private final ArrivalSerializer arrivals = new ArrivalSerializer();
    private final DeviceSerializer devices = new DeviceSerializer();

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
            arrivals.writePart(arrival, out);
        }
        Map<Device, Shortlist> shortlists = all.shortlists();
        out.writeInt(shortlists.size());
        for (Map.Entry<Device, Shortlist> each : shortlists.entrySet()) {
            devices.writePart(each.getKey(), out);
            CellSerializer.write(each.getValue(), out);
        }
    }

    @Override
    public Arrivals read(int version, DataInputView in) throws IOException {
        if (version < 1 || version > VERSION) {
            throw unknown(version);
        }
        boolean versions = version > WITHOUT_VERSIONS;
        List<Arrival> all = new ArrayList<>();
        for (int left = in.readInt(); left > 0; left--) {
            all.add(versions ? arrivals.readPart(in) : arrivals.read(1, in));
        }
        Map<Device, Shortlist> shortlists = new HashMap<>();
        for (int left = version > WITHOUT_SHORTLISTS ? in.readInt() : 0; left > 0; left--) {
            shortlists.put(versions ? devices.readPart(in) : devices.read(1, in), CellSerializer.readShortlist(in));
        }
        return of(all, shortlists);
    }

    @Override
    public Arrivals copy(Arrivals all) {
        return of(all.all(), all.shortlists());
    }

    private static Arrivals of(Iterable<Arrival> all, Map<Device, Shortlist> shortlists) {
        Arrivals arrivals = new Arrivals();
        all.forEach(
                arrival -> arrivals.put(arrival, shortlists.get(arrival.fix().device())));
        return arrivals;
    }

    @Override
    public boolean isImmutable() {
        return false;
    }
}
