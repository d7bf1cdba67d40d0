package io.furrow.cli.control;

import java.util.regex.Matcher;
import java.util.regex.Pattern;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;

/** Where a record is: {@code <topic>-<partition>@<offset>}, as lists print it. */
record RecordPlace(String topic, String partition, String offset) {
    /** For descriptions of arguments. */
    static final String FORM = "<topic>-<partition>@<offset>, as list shows it, for instance ";

    private static final Pattern PLACE = Pattern.compile("(.+)-([0-9]+)@([0-9]+)");

    static RecordPlace of(ControlOptions control, String text) {
        Matcher place = PLACE.matcher(text);
        if (!place.matches()) {
            throw control.refused("write %sdata.raw-0@17, not %s".formatted(FORM, text));
        }
        return new RecordPlace(place.group(1), place.group(2), place.group(3));
    }

    /** The path of the record. @param between topic and partition */
    String path(String between) {
        return ControlApi.part(topic) + between + "/" + partition + "/" + offset;
    }
}
