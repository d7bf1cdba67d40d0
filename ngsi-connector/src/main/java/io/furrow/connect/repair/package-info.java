/** Detects missed notifications and reads the changes from the context broker. Independent of Connect. */
package io.furrow.connect.repair;
