package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;

/** How a {@link Meeting} is written. */
public final class MeetingFormat extends Format<Meeting> {
    private static final long serialVersionUID = 1L;
    /** Start, closest distance, newest report. */
    private static final int VERSION = 1;

    @Override
    public Class<Meeting> type() {
        return Meeting.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(Meeting meeting, DataOutputView out) throws IOException {
        out.writeLong(meeting.startTime());
        out.writeDouble(meeting.minDistance());
        out.writeLong(meeting.reported());
    }

    @Override
    public Meeting read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new Meeting(in.readLong(), in.readDouble(), in.readLong());
    }
}
