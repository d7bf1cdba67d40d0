/** Translates notifications into records. */
package io.furrow.connect.source.notification;
