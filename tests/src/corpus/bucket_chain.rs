//! Long enough that the compiler leaves the explicit partial derivatives to the runtime.

machine! {
    /// Fourteen equal buckets hanging from a slowly turning head, each hinge rubbing a little.
    pub mechanism BucketChain {
        input omega: rpm;
        design pitch = 120 mm +/- 0.5 mm;
        design bucket = 350 g +/- 10 g;
        design friction = 0.02 N*m*s/rad;
        gravity 9.81 m/s^2 along -z;
        body head: massless;
        joint spin: revolute(z) from ground to head, driven at omega;
        body bucket1: rod(mass: bucket, length: pitch, along: -z);
        joint hinge1: revolute(y) from head to bucket1 at [30 mm, 0, 0];
        force rub1: damper(on: hinge1, damping: friction);
        body bucket2: rod(mass: bucket, length: pitch, along: -z);
        joint hinge2: revolute(y) from bucket1 to bucket2 at [0, 0, -pitch];
        force rub2: damper(on: hinge2, damping: friction);
        body bucket3: rod(mass: bucket, length: pitch, along: -z);
        joint hinge3: revolute(y) from bucket2 to bucket3 at [0, 0, -pitch];
        force rub3: damper(on: hinge3, damping: friction);
        body bucket4: rod(mass: bucket, length: pitch, along: -z);
        joint hinge4: revolute(y) from bucket3 to bucket4 at [0, 0, -pitch];
        force rub4: damper(on: hinge4, damping: friction);
        body bucket5: rod(mass: bucket, length: pitch, along: -z);
        joint hinge5: revolute(y) from bucket4 to bucket5 at [0, 0, -pitch];
        force rub5: damper(on: hinge5, damping: friction);
        body bucket6: rod(mass: bucket, length: pitch, along: -z);
        joint hinge6: revolute(y) from bucket5 to bucket6 at [0, 0, -pitch];
        force rub6: damper(on: hinge6, damping: friction);
        body bucket7: rod(mass: bucket, length: pitch, along: -z);
        joint hinge7: revolute(y) from bucket6 to bucket7 at [0, 0, -pitch];
        force rub7: damper(on: hinge7, damping: friction);
        body bucket8: rod(mass: bucket, length: pitch, along: -z);
        joint hinge8: revolute(y) from bucket7 to bucket8 at [0, 0, -pitch];
        force rub8: damper(on: hinge8, damping: friction);
        body bucket9: rod(mass: bucket, length: pitch, along: -z);
        joint hinge9: revolute(y) from bucket8 to bucket9 at [0, 0, -pitch];
        force rub9: damper(on: hinge9, damping: friction);
        body bucket10: rod(mass: bucket, length: pitch, along: -z);
        joint hinge10: revolute(y) from bucket9 to bucket10 at [0, 0, -pitch];
        force rub10: damper(on: hinge10, damping: friction);
        body bucket11: rod(mass: bucket, length: pitch, along: -z);
        joint hinge11: revolute(y) from bucket10 to bucket11 at [0, 0, -pitch];
        force rub11: damper(on: hinge11, damping: friction);
        body bucket12: rod(mass: bucket, length: pitch, along: -z);
        joint hinge12: revolute(y) from bucket11 to bucket12 at [0, 0, -pitch];
        force rub12: damper(on: hinge12, damping: friction);
        body bucket13: rod(mass: bucket, length: pitch, along: -z);
        joint hinge13: revolute(y) from bucket12 to bucket13 at [0, 0, -pitch];
        force rub13: damper(on: hinge13, damping: friction);
        body bucket14: rod(mass: bucket, length: pitch, along: -z);
        joint hinge14: revolute(y) from bucket13 to bucket14 at [0, 0, -pitch];
        force rub14: damper(on: hinge14, damping: friction);
        point lowest: bucket14 at [0, 0, -pitch];
        output swing = distance_from_axis(lowest, z);
    }
}
